// What the page does first: it shows that the program works here. `bytes`: a promise of those of play.wasm.

async function start(bytes) {
  const output = document.getElementById('output');
  try {
    const program = await Cbc.load(bytes);
    const { stdout } = await program.run(['--version']);
    output.textContent = new TextDecoder().decode(stdout);
    output.dataset.state = 'ready';
    window.program = program;
  } catch (error) {
    output.textContent = `The program cannot be started: ${error}`;
    output.dataset.state = 'failed';
  }
}
