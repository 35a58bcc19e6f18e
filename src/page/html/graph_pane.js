// The pane beside the timeline in which the state is drawn as a graph.

const shareOfGraph = 0.34; // of the width, at most
const leastScale = 0.75;

const changeNames = {
  started: 'started by this event',
  stopped: 'stopped by this event',
  replaced: 'its behavior was replaced by this event',
};

const changeSigns = { started: '+', stopped: '\u2212', replaced: '\u21c4' };

/** A sign at the corner of a node. */
const nodeSign = (x, y, sign) => [
  svgElement('circle', { cx: x, cy: y, r: 7, class: 'node-sign' }),
  svgElement('text', { x, y: y + 3.8, 'text-anchor': 'middle', class: 'node-sign-text' }, sign),
];

/** The node of a task, with the sign of what the event did to it. */
function nodeElement(graph, node) {
  const group = svgElement('g', { class: `node ${node.cause} ${node.change}`, transform: `translate(${node.x} ${node.y})` });
  const { title, text } = graph.textsOf(node);
  const room = node.width - 16;
  const badge = node.priority === undefined ? 0 : 24;
  group.append(svgElement('rect', { width: node.width, height: nodeHeight, rx: 6 }),
    svgElement('text', { x: 8, y: 14, class: 'node-task' }, shortenMiddle(title, room - badge, '600')),
    svgElement('text', { x: 8, y: 27 }, shortenMiddle(text, room)));
  if (badge > 0) group.append(svgElement('text', { x: node.width - 8, y: 14, 'text-anchor': 'end' }, `P${node.priority}`));
  if (node.change !== '') group.append(...nodeSign(node.width, 0, changeSigns[node.change]));
  const notes = [`${node.task}: ${node.behavior}`];
  if (node.change === 'replaced') notes.push(`replaces ${node.was}`);
  if (node.change !== '') notes.push(changeNames[node.change]);
  group.append(svgElement('title', {}, notes.join('\n')));
  return group;
}

function edgeElement({ from, to, path, isStopped }) {
  const look = isStopped ? 'edge stopped' : 'edge';
  const element = svgElement('path', { d: path, class: look, 'marker-end': 'url(#edge-head)' });
  element.append(svgElement('title', {}, `${from.task} requires ${to.task}`));
  return element;
}

/** What the edges of a picture end with. */
function edgeHeads() {
  const head = svgElement('marker', {
    id: 'edge-head', viewBox: '0 0 8 8', refX: 4, refY: 4, markerWidth: 6, markerHeight: 6, orient: 'auto',
  });
  head.append(svgElement('path', { d: 'M0 0 L8 4 L0 8 Z', class: 'edge-head' }));
  const definitions = svgElement('defs');
  definitions.append(head);
  return definitions;
}

class GraphPane {
  /** `section` is all of the pane, `body` the part with the picture. */
  constructor(section, body) {
    this.section = section;
    this.body = body;
    this.isWanted = false;
    this.room = null;
    this.narrow = matchMedia('(max-width: 900px)'); // the pane is below the timeline then
    const observer = new ResizeObserver(() => {
      this.room = null;
      this.draw();
    });
    for (const element of [section.parentElement, body]) observer.observe(element);
  }

  want(isWanted) {
    this.isWanted = isWanted;
    this.draw();
  }

  /** Shows the state after an event; of number 0, nothing. */
  show(run, number) {
    if (run !== this.run) this.width = 0;
    Object.assign(this, { run, number });
    this.draw();
  }

  /** The pane is as wide as its picture needs. Within a run it does not get narrower again, so that the
   * timeline beside it moves little; but where nothing runs, the timeline has the room. */
  draw() {
    const { section, body, run, number } = this;
    const graph = this.isWanted && number > 0 ? new StateGraph(run, number) : null;
    const isEmpty = graph === null || graph.nodes.size === 0;
    if (section.hidden !== isEmpty) this.room = null;
    section.hidden = isEmpty;
    if (isEmpty) return;
    this.room ??= this.measure();
    const { frame, most } = this.room;
    const room = [Math.max(200, most), this.room.height];
    const { width, height } = graph.place(...room);
    const scale = Math.max(leastScale, Math.min(1, room[0] / width, room[1] / height));
    this.width = Math.min(most, Math.max(this.width, Math.ceil(width * scale)));
    section.style.width = this.narrow.matches ? '' : `${this.width + frame}px`;
    body.replaceChildren(this.picture(graph, width, height, scale));
    if (width * scale <= room[0] && height * scale <= room[1]) return;
    const changed = [...graph.nodes.values()].find((node) => node.change !== '') ?? graph.nodes.values().next().value;
    body.scrollTo(changed.x * scale - room[0] / 3, changed.y * scale - room[1] / 3);
  }

  /** The room for a picture: this makes the browser lay out the page, so not for each of them. */
  measure() {
    const { section, body } = this;
    const frame = section.offsetWidth - body.clientWidth;
    const most = this.narrow.matches ? body.clientWidth : Math.floor(section.parentElement.clientWidth * shareOfGraph) - frame;
    return { frame, most, height: Math.max(150, body.clientHeight) };
  }

  picture(graph, width, height, scale) {
    const tasks = [...graph.nodes.values()].filter((node) => node.change !== 'stopped').map((node) => node.task);
    const svg = svgElement('svg', {
      width: width * scale, height: height * scale, viewBox: `0 0 ${width} ${height}`, role: 'img',
      'aria-label': `Graph of the tasks that run after event ${this.run.indexOf(this.number)}: ${tasks.join(', ') || 'none'}. ` +
        'The table of the state has the same content.',
    });
    // What goes on is drawn over what was stopped.
    const edges = [...graph.edges].sort((a, b) => b.isStopped - a.isStopped);
    svg.append(edgeHeads(), ...edges.map(edgeElement), ...[...graph.nodes.values()].map((node) => nodeElement(graph, node)));
    return svg;
  }
}
