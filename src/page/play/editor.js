// The bundle of CodeMirror: a text with line numbers, YAML in color, and findings. Becomes the global TextEditor.

import { isolateHistory } from '@codemirror/commands';
import { basicSetup } from 'codemirror';
import { yaml } from '@codemirror/lang-yaml';
import { HighlightStyle, syntaxHighlighting } from '@codemirror/language';
import { lintGutter, setDiagnostics } from '@codemirror/lint';
import { Annotation, EditorState } from '@codemirror/state';
import { EditorView, keymap } from '@codemirror/view';
import { tags } from '@lezer/highlight';

const colors = HighlightStyle.define([
  { tag: [tags.propertyName, tags.definition(tags.propertyName)], color: 'var(--requested-text)' },
  { tag: tags.comment, color: 'var(--muted)', fontStyle: 'italic' },
  { tag: [tags.string, tags.content], color: 'var(--ink)' },
]);

const theme = EditorView.theme({
  '&': { height: '100%', fontSize: '12.5px', color: 'var(--ink)', backgroundColor: 'var(--paper)' },
  '.cm-scroller': { fontFamily: 'ui-monospace, "DejaVu Sans Mono", monospace', overflow: 'auto' },
  '.cm-gutters': { backgroundColor: 'var(--panel)', color: 'var(--muted)', borderColor: 'var(--line)' },
  '.cm-activeLine, .cm-activeLineGutter': { backgroundColor: 'color-mix(in srgb, var(--accent) 8%, transparent)' },
  '&.cm-focused .cm-cursor': { borderLeftColor: 'var(--ink)' },
  '.cm-tooltip, .cm-panels': { backgroundColor: 'var(--paper)', color: 'var(--ink)', borderColor: 'var(--muted)' },
  '.cm-selectionBackground, &.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground':
    { backgroundColor: 'color-mix(in srgb, var(--accent) 28%, transparent) !important' },
});

/** Of a change that the page makes. */
const byPage = Annotation.define();

/** What differs between two texts, without what they begin and end with. */
function changeBetween(from, to) {
  const least = Math.min(from.length, to.length);
  let begin = 0;
  while (begin < least && from[begin] === to[begin]) ++begin;
  let end = 0;
  while (end < least - begin && from[from.length - 1 - end] === to[to.length - 1 - end]) ++end;
  return { from: begin, to: from.length - end, insert: to.slice(begin, to.length - end) };
}

export class TextEditor {
  /** `onChange(text)`: after somebody has typed. */
  constructor(parent, label, onChange) {
    this.onChange = onChange;
    this.label = label;
    this.view = new EditorView({ parent, state: this.newState(label, '') });
    this.view.scrollDOM.tabIndex = 0; // so that keys can scroll long lines
  }

  newState(label, text) {
    return EditorState.create({ doc: text, extensions: [
      basicSetup, yaml(), syntaxHighlighting(colors), theme, lintGutter(),
      EditorView.contentAttributes.of({ 'aria-label': label }),
      // Tab does not write, so it goes on to the next control; Escape leaves, too.
      keymap.of([{ key: 'Escape', run: (view) => { view.contentDOM.blur(); return true; } }]),
      EditorView.updateListener.of((update) => {
        const isByPage = update.transactions.every((transaction) => transaction.annotation(byPage));
        if (update.docChanged && !isByPage) this.onChange(this.text);
      }),
    ] });
  }

  get hasFocus() {
    return this.view.hasFocus;
  }

  get text() {
    return this.view.state.doc.toString();
  }

  /** Another text, which nobody has typed. */
  set text(text) {
    if (text === this.text) return;
    this.view.setState(this.newState(this.label, text)); // there is nothing to undo
  }

  /** The same, but the text from before comes back by "undo" of the editor. */
  write(text) {
    if (text === this.text) return;
    this.view.dispatch({ changes: changeBetween(this.text, text), annotations: [byPage.of(true), isolateHistory.of('full')] });
  }

  /** Findings as in cbc.lint/1. */
  set findings(findings) {
    const { doc } = this.view.state;
    // Columns of findings count characters.
    const offset = ({ line, column }) => {
      const { from, text } = doc.line(Math.min(line, doc.lines));
      return from + [...text].slice(0, column - 1).join('').length;
    };
    this.view.dispatch(setDiagnostics(this.view.state, findings.map((finding) => ({
      from: offset(finding),
      to: Math.max(offset(finding), offset({ line: finding.end_line, column: finding.end_column })),
      severity: { error: 'error', warning: 'warning', note: 'info' }[finding.severity],
      source: finding.rule,
      message: finding.message,
    }))));
  }

  /** Shows a line, with the cursor in it. */
  show(line) {
    const { from } = this.view.state.doc.line(Math.min(line, this.view.state.doc.lines));
    this.view.dispatch({ selection: { anchor: from }, effects: EditorView.scrollIntoView(from, { y: 'center' }) });
    this.view.focus();
  }
}
