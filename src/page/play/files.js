// The files of `cbc play`: the server of this page puts a text into the file that it came from, on request.

/** The button in a pane that saves its text, and what is asked if the file has changed meanwhile. */
class FileSaver {
  /** `role`: 'catalog', 'mission' or 'properties'. `load(text)` takes the text of the file. */
  constructor(role, editor, { load, onNote, onSaved }) {
    this.role = role;
    this.editor = editor;
    this.load = load;
    this.onNote = onNote;
    this.onSaved = onSaved;
    this.row = byId(`file-${role}`);
  }

  /** `file`: {name, version}; undefined if the text comes from no file. */
  open(file, text) {
    this.file = file;
    // The editor knows but one end of lines.
    this.lineEnd = text.includes('\r\n') ? '\r\n' : '\n';
    this.row.hidden = file === undefined;
    if (file !== undefined) this.showButton();
  }

  showButton() {
    this.row.replaceChildren(buttonElement(`save to ${this.file.name}`, () => this.save()));
  }

  async save() {
    const { file } = this;
    for (const button of this.row.querySelectorAll('button')) button.disabled = true; // one after the other
    try {
      const answer = await this.put(this.editor.text.replaceAll('\n', this.lineEnd));
      if (this.file !== file) return; // another session was opened
      file.version = answer.version;
      if (answer.text !== undefined) return this.showConflict(answer.text);
      this.onSaved();
      this.onNote(`${file.name} is saved.`, false);
    } catch (error) {
      if (this.file !== file) return;
      this.onNote(`${file.name} was not saved: ${error.message}`, true);
    }
    this.showButton();
  }

  /** {version}, and the text of the file if it is another version that was to be replaced. */
  async put(text) {
    const address = new URL(`${this.role}?version=${this.file.version}`, location.href);
    let response;
    try {
      response = await fetch(address, { method: 'PUT', body: text });
    } catch {
      throw new Error('the program that serves this page does not answer');
    }
    if (response.headers.get('content-type') !== 'application/json') throw new Error((await response.text()).trim());
    const answer = await response.json();
    if (answer.error !== undefined) throw new Error(answer.error);
    return answer;
  }

  /** `text`: null if the file cannot be read any more. */
  showConflict(text) {
    this.onNote(`${this.file.name} was not saved.`, true);
    const what = text === null ? 'cannot be read any more' : 'was changed by another program';
    const buttons = [buttonElement('save all the same', () => this.save())];
    if (text !== null) {
      buttons.push(buttonElement('load the other text', () => {
        this.open(this.file, text);
        this.editor.text = text;
        this.onNote('', false);
        return this.load(text);
      }));
    }
    this.row.replaceChildren(html('span', 'bad', `${this.file.name} ${what}: `), ...buttons);
  }
}
