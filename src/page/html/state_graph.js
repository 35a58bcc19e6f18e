// The state after an event as a graph: the tasks that run, in layers: those that are requested
// first, then those they require. What the event started, replaced or stopped stands out.

const nodeHeight = 34;
const nodeGap = 8;
const layerGap = 34;
const graphMargin = 8;
const widestNode = 190;

/** The tasks that run after an event or ran before it, and which requires which. */
class StateGraph {
  constructor(run, number) {
    this.run = run;
    const before = run.running(number - 1);
    const after = run.running(number);
    const names = run.catalog.sortTasks(new Set([...Object.keys(after), ...Object.keys(before)]));
    this.nodes = new Map(names.map((task) => {
      const [was, is] = [get(before, task), get(after, task)];
      const change = was === undefined ? 'started' : is === undefined ? 'stopped' : was === is ? '' : 'replaced';
      const shown = is === undefined ? number - 1 : number;
      const priority = get(run.requests(shown), task);
      const behavior = is ?? was;
      return [task, { task, behavior, was, change, priority, cause: run.spanAt(shown, task).cause }];
    }));
    const edges = [];
    for (const from of this.nodes.values()) {
      for (const task of run.catalog.behaviors.get(from.behavior)?.requires ?? []) {
        const to = this.nodes.get(task);
        // What runs requires nothing of what was stopped.
        if (to === undefined || (to.change === 'stopped' && from.change !== 'stopped')) continue;
        edges.push({ from, to, isStopped: from.change === 'stopped' });
      }
    }
    this.edges = edges;
    this.layout = new LayeredGraph([...this.nodes.values()], edges);
  }

  /** Gives the nodes and edges their places, and tells the size of all: layers from top to bottom, or from
   * left to right if that fits better into a size. */
  place(width, height) {
    const fit = (size) => Math.min(1, width / size.width, height / size.height);
    const across = this.placeLayers(false);
    const down = this.placeLayers(true, this.shareOf(width));
    return fit(down) >= fit(across) ? down : this.placeLayers(false);
  }

  /** The width of each node if the layers lie in a width; not less than names can be shortened to. */
  shareOf(width) {
    const shares = this.layout.layers.map((layer) => {
      const nodes = layer.filter((item) => item.node !== null).length;
      const lanes = (layer.length - nodes) * (laneBreadth + nodeGap);
      return (width - 2 * graphMargin - lanes) / nodes - nodeGap;
    });
    return Math.max(130, Math.min(...shares));
  }

  /** `share`: the most that a node is wide, if the layers go from top to bottom. */
  placeLayers(isDown, share = widestNode) {
    const widthOfAll = (nodes, least) => Math.min(share, Math.max(least, ...nodes.map((node) => this.widthOf(node))));
    const nodesOf = (layer) => layer.map((item) => item.node).filter((node) => node !== null);
    const same = widthOfAll([...this.nodes.values()], 110);
    const { layers } = this.layout;
    const breadth = 2 * graphMargin + this.layout.spread(() => (isDown ? same : nodeHeight), nodeGap);
    let begin = graphMargin;
    for (const layer of layers) {
      const depth = isDown ? nodeHeight : widthOfAll(nodesOf(layer), 90);
      for (const item of layer) {
        item.middle += graphMargin;
        Object.assign(item, { begin, end: begin + depth });
        if (item.node === null) continue;
        const corner = item.middle - item.breadth / 2;
        Object.assign(item.node, isDown ? { x: corner, y: begin, width: same } : { x: begin, y: corner, width: depth });
      }
      begin += depth + layerGap;
    }
    for (const edge of this.edges) edge.path = this.pathOf(edge, isDown);
    const depth = begin - layerGap + graphMargin;
    return isDown ? { width: breadth, height: depth } : { width: depth, height: breadth };
  }

  /** A curve from layer to layer, and straight through the layers that the edge passes. */
  pathOf({ from, to, lanes }, isDown) {
    const bend = layerGap * 0.6;
    const point = (along, depth) => (isDown ? `${along} ${depth}` : `${depth} ${along}`);
    const { items } = this.layout;
    const stops = [items.get(from), ...lanes, items.get(to)];
    let path = `M${point(stops[0].middle, stops[0].end)}`;
    stops.slice(1).forEach((next, place) => {
      const last = stops[place];
      const end = next.node === null ? next.begin : next.begin - 5; // before the node is the arrowhead
      path += ` C${point(last.middle, last.end + bend)} ${point(next.middle, end - bend)} ${point(next.middle, end)}`;
      if (next.node === null) path += ` L${point(next.middle, next.end)}`;
    });
    return path;
  }

  textsOf(node) {
    const share = this.run.catalog.suitability(node.behavior, node.task);
    return { title: node.task, text: share === undefined || share === 100 ? node.behavior : `${node.behavior}, ${share} %` };
  }

  widthOf(node) {
    const { title, text } = this.textsOf(node);
    return Math.max(measure(title, '600') + (node.priority === undefined ? 0 : 24), measure(text)) + 20;
  }
}
