// The clock of the robot. It stands still until it is moved, or runs with that of the wall: then the session hears of it
// when something falls due, when somebody asks for something, and when it is paused.

const tickOfClock = 100; // milliseconds

class Clock {
  /** `onTick(seconds)`: it shows another time. */
  constructor(simulation, engine, onTick) {
    Object.assign(this, { simulation, engine, onTick });
    this.timer = null;
    this.time = null; // seconds; null: it does not run
    byId('step').addEventListener('click', () => {
      this.pause();
      return simulation.step(1);
    });
    byId('to-next').addEventListener('click', () => {
      this.halt();
      return simulation.advance();
    });
    byId('run').addEventListener('click', () => (this.timer === null ? this.run() : this.pause()));
  }

  run() {
    if (!this.simulation.isOpen) return;
    this.show(true);
    this.time = this.simulation.place.time;
    let last = performance.now();
    this.timer = setInterval(() => {
      const { due, place } = this.simulation;
      const seconds = (performance.now() - last) / 1000;
      last = performance.now();
      if (this.engine.isBusy) return;
      this.time = Math.max(this.time, place.time) + seconds;
      this.onTick(this.time);
      if (due.next !== null && this.time >= due.next) this.simulation.advance(due.next);
    }, tickOfClock);
  }

  /** Stops at the time that it shows. */
  pause() {
    const { time } = this;
    this.halt();
    if (time !== null) this.simulation.advance(time);
  }

  /** Stops; the robot stays where it is. */
  halt() {
    clearInterval(this.timer);
    this.timer = null;
    this.time = null;
    this.show(false);
  }

  show(isRunning) {
    byId('run').setAttribute('aria-pressed', `${isRunning}`);
    byId('run').textContent = isRunning ? 'pause' : 'run';
  }
}
