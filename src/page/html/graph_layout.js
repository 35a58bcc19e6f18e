// Places the nodes of a graph in layers. An edge that passes a layer has a lane there, beside the nodes, so
// that it passes behind none of them. Nothing here touches the page.

const laneBreadth = 6;
const sweepCount = 8; // after these, graphs of this size hardly get better

const meanOf = (numbers) => numbers.reduce((sum, number) => sum + number, 0) / numbers.length;

/** A graph without circles: each edge goes from a layer to a later one. */
class LayeredGraph {
  /** `nodes`: of any kind. `edges`: {from, to}, both nodes; they get `lanes`. */
  constructor(nodes, edges) {
    this.edges = edges;
    // What stands in a layer: a node, or a lane if `node` is null. `above`, `below`: what it is joined with.
    this.items = new Map(nodes.map((node) => [node, { node, layer: 0, above: [], below: [] }]));
    this.setLayers();
    this.addLanes();
    this.sortLayers();
  }

  /** A node is one layer after the last one with an edge to it. */
  setLayers() {
    for (let isStable = false; !isStable;) {
      isStable = true;
      for (const { from, to } of this.edges) {
        const least = this.items.get(from).layer + 1;
        if (this.items.get(to).layer >= least) continue;
        this.items.get(to).layer = least;
        isStable = false;
      }
    }
    this.layers = [];
    for (const item of this.items.values()) (this.layers[item.layer] ??= []).push(item);
  }

  /** Edges to the same node share their lanes: whichever of them one follows, it leads there. */
  addLanes() {
    for (const edge of this.edges) {
      const [from, to] = [this.items.get(edge.from), this.items.get(edge.to)];
      to.lanes ??= [];
      edge.lanes = [];
      let last = from;
      for (let layer = from.layer + 1; layer < to.layer; ++layer) {
        if (to.lanes[layer] === undefined) {
          to.lanes[layer] = { node: null, layer, above: [], below: [] };
          this.layers[layer].push(to.lanes[layer]);
        }
        edge.lanes.push(to.lanes[layer]);
        this.join(last, to.lanes[layer]);
        last = to.lanes[layer];
      }
      this.join(last, to);
    }
  }

  join(upper, lower) {
    if (upper.below.includes(lower)) return;
    upper.below.push(lower);
    lower.above.push(upper);
  }

  /** What is joined stands near each other, so that few lines cross. */
  sortLayers() {
    const number = () => this.layers.forEach((layer) => layer.forEach((item, place) => (item.place = place)));
    number();
    let best = this.layers.map((layer) => [...layer]);
    let fewest = this.countCrossings();
    for (let sweep = 0; sweep < sweepCount && fewest > 0; ++sweep) {
      const isDown = sweep % 2 === 0;
      for (const layer of isDown ? this.layers : [...this.layers].reverse()) {
        for (const item of layer) {
          const neighbors = isDown ? item.above : item.below;
          item.weight = neighbors.length === 0 ? item.place : meanOf(neighbors.map(({ place }) => place));
        }
        layer.sort((a, b) => a.weight - b.weight);
        layer.forEach((item, place) => (item.place = place));
      }
      const count = this.countCrossings();
      if (count >= fewest) continue;
      fewest = count;
      best = this.layers.map((layer) => [...layer]);
    }
    this.layers = best;
    number();
  }

  countCrossings() {
    let count = 0;
    for (const layer of this.layers) {
      const lines = layer.flatMap((item) => item.below.map((other) => [item.place, other.place]));
      lines.forEach(([begin, end], index) => {
        for (const [otherBegin, otherEnd] of lines.slice(index + 1)) {
          if ((begin - otherBegin) * (end - otherEnd) < 0) ++count;
        }
      });
    }
    return count;
  }

  /** Gives all items their `middle` along their layers, near what they are joined with, and tells how
   * long the longest layer is. `breadthOf`: the breadth of a node. */
  spread(breadthOf, gap) {
    for (const layer of this.layers) {
      for (const item of layer) item.breadth = item.node === null ? laneBreadth : breadthOf(item.node);
    }
    const lengthOf = (layer) => layer.reduce((sum, item) => sum + item.breadth + gap, -gap);
    const whole = Math.max(0, ...this.layers.map(lengthOf));
    for (const layer of this.layers) {
      let edge = (whole - lengthOf(layer)) / 2;
      for (const item of layer) {
        item.middle = edge + item.breadth / 2;
        edge += item.breadth + gap;
      }
    }
    for (let sweep = 0; sweep < sweepCount; ++sweep) {
      for (const layer of sweep % 2 === 0 ? this.layers : [...this.layers].reverse()) settle(layer, gap, whole);
    }
    return whole;
  }
}

/** Moves the items of a layer as near to what they are joined with as they can get (with the least sum of
 * squares) in their order, with gaps between them, and within a length. */
function settle(layer, gap, length) {
  // Where an item would begin if those before it took no room: these places only have to be in order.
  const begins = [];
  let taken = 0;
  const blocks = []; // of items that touch: {sum of what they want, count}
  for (const item of layer) {
    const neighbors = [...item.above, ...item.below];
    const wanted = neighbors.length === 0 ? item.middle : meanOf(neighbors.map(({ middle }) => middle));
    begins.push(taken + item.breadth / 2);
    blocks.push({ sum: wanted - begins.at(-1), count: 1 });
    while (blocks.length > 1 && blocks.at(-2).sum / blocks.at(-2).count >= blocks.at(-1).sum / blocks.at(-1).count) {
      const last = blocks.pop();
      blocks.at(-1).sum += last.sum;
      blocks.at(-1).count += last.count;
    }
    taken += item.breadth + gap;
  }
  const room = length - taken + gap;
  let place = 0;
  for (const { sum, count } of blocks) {
    const shift = Math.min(room, Math.max(0, sum / count));
    for (const end = place + count; place < end; ++place) layer[place].middle = begins[place] + shift;
  }
}
