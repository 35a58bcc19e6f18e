// The part of the address after "#": which mission and which event are shown, for links and reloads.

class Address {
  /** `onChange({place, index})`: the address was changed by hand, by a link, or by "back". */
  constructor(runs, onChange) {
    this.names = Address.uniqueNames(runs);
    this.timer = null;
    addEventListener('hashchange', () => {
      const wanted = this.read();
      if (wanted !== null) onChange(wanted);
    });
  }

  /** The scripts; a script that occurs again has its number behind it. */
  static uniqueNames(runs) {
    const counts = new Map();
    return runs.map((run) => {
      const name = run.data.script;
      counts.set(name, (counts.get(name) ?? 0) + 1);
      return counts.get(name) === 1 ? name : `${name}~${counts.get(name)}`;
    });
  }

  /** {place, index} of the address, or null if it names no mission of this page. */
  read() {
    const wanted = new URLSearchParams(location.hash.slice(1));
    const place = wanted.has('mission') ? this.names.indexOf(wanted.get('mission')) : 0;
    if (place === -1 || (!wanted.has('mission') && !wanted.has('event'))) return null;
    const index = Number.parseInt(wanted.get('event') ?? '', 10);
    return { place, index: Number.isNaN(index) ? null : index };
  }

  text(place, index) {
    return `#${new URLSearchParams({ mission: this.names[place], event: index })}`;
  }

  clear() {
    clearTimeout(this.timer);
    if (location.hash !== '') history.replaceState(null, '', location.pathname);
  }

  /** Writes it soon: browsers limit how often a page may. */
  write(place, index) {
    const text = this.text(place, index);
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      if (location.hash !== text) history.replaceState(null, '', text);
    }, 100);
  }
}
