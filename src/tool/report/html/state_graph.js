// The state after an event as a graph: the tasks that run, in layers: those that are requested
// first, then those they require. What the event started, replaced or stopped stands out.

const nodeHeight = 34;
const nodeGap = 8;
const layerGap = 34;
const graphMargin = 8;
const widestNode = 190;

/** The tasks that run after an event or ran before it, with their layers. */
class StateGraph {
  constructor(run, number) {
    this.run = run;
    const before = run.running(number - 1);
    const after = run.running(number);
    const names = run.catalog.sortTasks(new Set([...Object.keys(after), ...Object.keys(before)]));
    this.nodes = new Map(names.map((task) => {
      const [was, is] = [get(before, task), get(after, task)];
      const change = was === undefined ? 'started' : is === undefined ? 'stopped' : was === is ? '' : 'replaced';
      const priority = get(run.requests(is === undefined ? number - 1 : number), task);
      const behavior = is ?? was;
      return [task, { task, behavior, was, change, priority, cause: causeOf(priority), layer: 0, requirers: [] }];
    }));
    this.edges = [];
    for (const node of this.nodes.values()) {
      for (const task of run.catalog.behaviors.get(node.behavior)?.requires ?? []) {
        const required = this.nodes.get(task);
        // What runs requires nothing of what was stopped.
        if (required === undefined || (required.change === 'stopped' && node.change !== 'stopped')) continue;
        this.edges.push({ from: node, to: required });
        required.requirers.push(node);
      }
    }
    this.setLayers();
  }

  /** A task is one layer after the last one that requires it. The number of rounds is limited, since
   * requirements may run in a circle. */
  setLayers() {
    for (let round = 0; round < this.nodes.size; ++round) {
      let isStable = true;
      for (const { from, to } of this.edges) {
        if (to.layer > from.layer || from.layer + 1 >= this.nodes.size) continue;
        to.layer = from.layer + 1;
        isStable = false;
      }
      if (isStable) break;
    }
    this.layers = [];
    for (const node of this.nodes.values()) (this.layers[node.layer] ??= []).push(node);
    this.layers = this.layers.filter((layer) => layer !== undefined);
    // Tasks stand near what requires them, so that few lines cross.
    for (const layer of this.layers) {
      for (const node of layer) {
        const rows = node.requirers.map((requirer) => requirer.row ?? 0);
        node.weight = rows.length === 0 ? 0 : rows.reduce((sum, row) => sum + row, 0) / rows.length;
      }
      layer.sort((a, b) => a.weight - b.weight);
      layer.forEach((node, row) => (node.row = row));
    }
  }

  /** Gives the nodes their places, and tells the size of all: layers from top to bottom, or from left to
   * right if that fits better into a size. */
  place(width, height) {
    const fit = (size) => Math.min(1, width / size.width, height / size.height);
    const [down, across] = [this.placeDown(width), this.placeAcross()];
    this.isDown = fit(down) >= fit(across);
    return this.isDown ? this.placeDown(width) : across;
  }

  /** In a width, if the names can be shortened to it. */
  placeDown(room) {
    const most = Math.max(1, ...this.layers.map((layer) => layer.length));
    const share = (room - 2 * graphMargin - 8) / most - nodeGap;
    const natural = Math.max(110, ...[...this.nodes.values()].map((node) => this.widthOf(node)));
    const width = Math.min(natural, Math.max(130, share));
    const whole = most * (width + nodeGap) - nodeGap + 2 * graphMargin;
    this.layers.forEach((layer, place) => {
      const used = layer.length * (width + nodeGap) - nodeGap;
      layer.forEach((node, row) => Object.assign(node, {
        width, x: (whole - used) / 2 + row * (width + nodeGap), y: graphMargin + place * (nodeHeight + layerGap),
      }));
    });
    return { width: whole, height: this.layers.length * (nodeHeight + layerGap) - layerGap + 2 * graphMargin };
  }

  placeAcross() {
    const most = Math.max(1, ...this.layers.map((layer) => layer.length));
    const height = most * (nodeHeight + nodeGap) - nodeGap + 2 * graphMargin;
    let x = graphMargin;
    for (const layer of this.layers) {
      const width = Math.min(widestNode, Math.max(90, ...layer.map((node) => this.widthOf(node))));
      const used = layer.length * (nodeHeight + nodeGap) - nodeGap;
      layer.forEach((node, row) => Object.assign(node, {
        x, width, y: (height - used) / 2 + row * (nodeHeight + nodeGap),
      }));
      x += width + layerGap;
    }
    return { width: Math.max(x - layerGap, 0) + graphMargin, height };
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

const changeNames = {
  started: 'started by this event',
  stopped: 'stopped by this event',
  replaced: 'its behavior was replaced by this event',
};

/** The node of a task, with the sign of what the event did to it. */
function nodeElement(graph, node) {
  const group = svgElement('g', { class: `node ${node.cause} ${node.change}`, transform: `translate(${node.x} ${node.y})` });
  const { title, text } = graph.textsOf(node);
  const sign = { started: '+', stopped: '\u2212', replaced: '\u21c4' }[node.change];
  const room = node.width - 16;
  const badge = node.priority === undefined ? 0 : 24;
  group.append(svgElement('rect', { width: node.width, height: nodeHeight, rx: 6 }),
    svgElement('text', { x: 8, y: 14, class: 'node-task' }, shortenMiddle(title, room - badge, '600')),
    svgElement('text', { x: 8, y: 27 }, shortenMiddle(text, room)));
  if (badge > 0) group.append(svgElement('text', { x: node.width - 8, y: 14, 'text-anchor': 'end' }, `P${node.priority}`));
  if (sign !== undefined) {
    group.append(svgElement('circle', { cx: node.width, cy: 0, r: 7, class: 'node-sign' }),
                 svgElement('text', { x: node.width, y: 3.8, 'text-anchor': 'middle', class: 'node-sign-text' }, sign));
  }
  const notes = [`${node.task}: ${node.behavior}`];
  if (node.change === 'replaced') notes.push(`replaces ${node.was}`);
  if (node.change !== '') notes.push(changeNames[node.change]);
  group.append(svgElement('title', {}, notes.join('\n')));
  return group;
}

function edgeElement({ from, to }, isDown) {
  const look = from.change === 'stopped' || to.change === 'stopped' ? 'edge stopped' : 'edge';
  const bend = layerGap * 0.6;
  const [x1, y1, x2, y2] = isDown
    ? [from.x + from.width / 2, from.y + nodeHeight, to.x + to.width / 2, to.y - 5]
    : [from.x + from.width, from.y + nodeHeight / 2, to.x - 5, to.y + nodeHeight / 2];
  const path = isDown ? `M${x1} ${y1} C${x1} ${y1 + bend} ${x2} ${y2 - bend} ${x2} ${y2}`
                      : `M${x1} ${y1} C${x1 + bend} ${y1} ${x2 - bend} ${y2} ${x2} ${y2}`;
  return svgElement('path', { d: path, class: look, 'marker-end': 'url(#edge-head)' });
}

/** Draws the state after an event. Where there is no room for all, what the event changed is in view. */
function fillGraph(body, run, number) {
  const graph = new StateGraph(run, number);
  if (graph.nodes.size === 0) {
    body.replaceChildren(html('p', 'why', 'No task runs.'));
    return;
  }
  const room = [Math.max(200, body.clientWidth), Math.max(150, body.clientHeight)];
  const { width, height } = graph.place(...room);
  const scale = Math.max(0.75, Math.min(1, room[0] / width, room[1] / height));
  const tasks = [...graph.nodes.values()].filter((node) => node.change !== 'stopped').map((node) => node.task);
  const svg = svgElement('svg', {
    width: width * scale, height: height * scale, viewBox: `0 0 ${width} ${height}`, role: 'img',
    'aria-label': `Graph of the tasks that run after event ${run.indexOf(number)}: ${tasks.join(', ') || 'none'}. ` +
      'The table of the state has the same content.',
  });
  const head = svgElement('marker', {
    id: 'edge-head', viewBox: '0 0 8 8', refX: 4, refY: 4, markerWidth: 6, markerHeight: 6, orient: 'auto',
  });
  head.append(svgElement('path', { d: 'M0 0 L8 4 L0 8 Z', class: 'edge-head' }));
  const definitions = svgElement('defs');
  definitions.append(head);
  svg.append(definitions, ...graph.edges.map((edge) => edgeElement(edge, graph.isDown)),
             ...[...graph.nodes.values()].map((node) => nodeElement(graph, node)));
  body.replaceChildren(svg);
  const changed = [...graph.nodes.values()].find((node) => node.change !== '') ?? graph.nodes.values().next().value;
  body.scrollTo(changed.x * scale - room[0] / 3, changed.y * scale - room[1] / 3);
}
