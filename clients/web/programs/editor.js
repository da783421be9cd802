/** A text one edits. It stands in a shadow root: only there does CodeMirror bring its style without loosening the page's policy. */

import {
  Decoration, defaultKeymap, drawSelection, EditorState, EditorView, gutter, GutterMarker, highlightActiveLine, history, historyKeymap,
  keymap, lineNumbers, search, searchKeymap, StateEffect, StateField,
} from '../bundled/codemirror.js';
import { h } from '../dom.js';
import { findingText, t } from '../i18n.js';
import { blockNumbers, isNumbered, klartext } from './klartext.js';

/** The words of CodeMirror, each a text of the page. */
const PHRASES = {
  Find: 'find', Replace: 'replace', next: 'next', previous: 'previous', all: 'all', 'match case': 'case', regexp: 'regexp', 'by word': 'word',
  replace: 'replace_one', 'replace all': 'replace_all', close: 'close', 'Go to line': 'go_to', go: 'go', 'current match': 'match', 'on line': 'on_line',
  'replaced $ matches': 'replaced', 'replaced match on line $': 'replaced_on',
};

const THEME = EditorView.theme({
  '&': { color: 'var(--ink)', backgroundColor: 'var(--sheet)', fontSize: '.875rem', borderRadius: '8px' },
  '&.cm-focused': { outline: '2px solid var(--focus)', outlineOffset: '2px' },
  '.cm-scroller': { fontFamily: 'ui-monospace, "Cascadia Mono", "JetBrains Mono", "DejaVu Sans Mono", monospace', lineHeight: '1.6', maxHeight: 'var(--editor-height, 32rem)', overflow: 'auto' },
  '.cm-content': { caretColor: 'var(--ink)', padding: '.5rem 0' },
  '.cm-cursor': { borderLeftColor: 'var(--ink)', borderLeftWidth: '2px' },
  '.cm-gutters': { color: 'var(--soft)', backgroundColor: 'var(--sheet)', borderRight: '1px solid var(--line)' },
  '.cm-lineNumbers .cm-gutterElement': { minWidth: '3.5rem', paddingRight: '.75rem', cursor: 'pointer' },
  '.cm-breaks': { minWidth: '1.5rem', cursor: 'pointer' },
  '.cm-breaks .cm-gutterElement': { textAlign: 'center', color: 'var(--alarm)' },
  '.cm-breaks .cm-gutterElement:hover': { backgroundColor: 'color-mix(in srgb, var(--alarm) 20%, transparent)' },
  '.cm-activeLine': { backgroundColor: 'color-mix(in srgb, var(--ink) 5%, transparent)' },
  '.cm-here': { backgroundColor: 'color-mix(in srgb, var(--focus) 16%, transparent)' },
  '&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground': { backgroundColor: 'color-mix(in srgb, var(--focus) 28%, transparent)' },
  '.cm-line.cm-error': { boxShadow: 'inset 4px 0 var(--alarm)' },
  '.cm-line.cm-warning': { boxShadow: 'inset 4px 0 var(--rework)' },
  '.cm-place': { textDecoration: 'underline wavy var(--alarm)', textUnderlineOffset: '3px' },
  '.cm-panels': { color: 'var(--ink)', backgroundColor: 'var(--paper)', borderColor: 'var(--line)' },
  '.cm-button, .cm-textfield': { backgroundImage: 'none', color: 'var(--ink)', backgroundColor: 'var(--sheet)', border: '1px solid var(--edge)', fontSize: '1rem' },
  '.cm-searchMatch': { backgroundColor: 'color-mix(in srgb, var(--rework) 40%, transparent)' },
  '@media print': { '.cm-scroller': { maxHeight: 'none', overflow: 'visible' }, '.cm-content': { whiteSpace: 'pre-wrap' } },
});

const setFindings = StateEffect.define();
const setHere = StateEffect.define();

/** Marks in the text that an effect replaces and that go with the text as it changes. */
const marked = (effect, marksOf) => StateField.define({
  create: () => Decoration.none,
  update(marks, { effects, changes, state }) {
    const given = effects.find((each) => each.is(effect));
    return given ? Decoration.set(marksOf(state.doc, given.value), true) : marks.map(changes);
  },
  provide: (field) => EditorView.decorations.from(field),
});

/** A finding marks its line, and the word that begins at its column. */
function marksOfFinding(doc, finding) {
  if (finding.line < 1 || finding.line > doc.lines) return [];
  const line = doc.line(finding.line);
  const begin = Math.min(Math.max(finding.column - 1, 0), Math.max(line.length - 1, 0));
  const word = /^\S+/.exec(line.text.slice(begin))?.[0].length ?? 1;
  const place = Decoration.mark({ class: 'cm-place', attributes: { title: findingText(finding) } });
  return [
    Decoration.line({ class: `cm-${finding.severity}` }).range(line.from),
    ...(line.length ? [place.range(line.from + begin, Math.min(line.from + begin + word, line.to))] : []),
  ];
}

const findings = marked(setFindings, (doc, found) => found.flatMap((each) => marksOfFinding(doc, each)));
const here = marked(setHere, (doc, line) => (line >= 1 && line <= doc.lines ? [Decoration.line({ class: 'cm-here' }).range(doc.line(line).from)] : []));

const setBreaks = StateEffect.define();
/** The blocks that have a breakpoint. */
const breaks = StateField.define({
  create: () => new Set(),
  update: (blocks, { effects }) => effects.find((each) => each.is(setBreaks))?.value ?? blocks,
});

/** A breakpoint beside the line in which its block begins. */
class BreakMark extends GutterMarker {
  toDOM() {
    return h('span', { title: t('steps.break') }, '●');
  }
}

/** The number of the block that a line is of. */
function blockAt(doc, line) {
  const numbers = blockNumbers(doc).slice(0, line);
  return Number(numbers.findLast((number) => number !== '') ?? NaN);
}

export class Editor {
  /**
   * @param onChange called when the text was edited; @param onLine takes the number of a line that was touched; @param onStore called on Ctrl+S
   * @param onBreak takes the number of a block at which a breakpoint is set or removed
   */
  constructor({ onChange, onLine, onStore, onBreak }) {
    Object.assign(this, { onChange, onLine, onStore, onBreak });
    this.element = h('div.editor');
    this.view = new EditorView({ root: this.element.attachShadow({ mode: 'open' }) });
    this.view.root.append(this.view.dom);
  }

  get text() {
    return this.view.state.doc.toString();
  }

  /** Another text, with a history of its own. Beside a program stand the numbers of its blocks, unless its text has them. */
  show(text, { label, isProgram, readOnly }) {
    const lineOf = (view, at) => view.state.doc.lineAt(at).number;
    const toggle = (view, at) => {
      const block = blockAt(view.state.doc, lineOf(view, at));
      if (isProgram && block >= 0) this.onBreak(block);
      return isProgram;
    };
    const mark = new BreakMark();
    this.view.setState(EditorState.create({
      doc: text,
      extensions: [
        THEME, findings, here, history(), drawSelection(), highlightActiveLine(), isProgram ? klartext : [], search({ top: true }),
        breaks, isProgram ? gutter({
          class: 'cm-breaks', renderEmptyElements: true,
          lineMarker: ({ state }, { from }) => (state.field(breaks).has(Number(blockNumbers(state.doc)[state.doc.lineAt(from).number - 1] || NaN)) ? mark : null),
          lineMarkerChange: ({ transactions }) => transactions.some(({ effects }) => effects.some((each) => each.is(setBreaks))),
          domEventHandlers: { click: (view, block) => toggle(view, block.from) },
        }) : [],
        isProgram && isNumbered(text) ? [] : lineNumbers({
          ...(isProgram && { formatNumber: (line, { doc }) => blockNumbers(doc)[line - 1] ?? '' }),
          domEventHandlers: { click: (view, block) => { this.onLine(lineOf(view, block.from)); return false; } },
        }),
        EditorState.readOnly.of(readOnly),
        EditorState.phrases.of(Object.fromEntries(Object.entries(PHRASES).map(([phrase, name]) => [phrase, t(`editor.${name}`)]))),
        EditorView.contentAttributes.of({ 'aria-label': label, tabindex: '0' }),
        keymap.of([{ key: 'F9', run: (view) => toggle(view, view.state.selection.main.head) }, { key: 'Mod-s', preventDefault: true, run: () => { this.onStore(); return true; } }, ...searchKeymap, ...historyKeymap, ...defaultKeymap]),
        EditorView.domEventHandlers({ mouseup: (_, view) => { this.onLine(lineOf(view, view.state.selection.main.head)); return false; } }),
        EditorView.updateListener.of(({ docChanged, transactions, view }) => {
          const byKeys = transactions.some((each) => each.isUserEvent('select') && !each.isUserEvent('select.pointer'));
          if (docChanged) this.onChange();
          else if (byKeys) this.onLine(lineOf(view, view.state.selection.main.head));
        }),
      ],
    }));
  }

  /** Puts another text in the place of this one, as an edit of what differs. */
  replace(text) {
    const old = this.text;
    const most = Math.min(old.length, text.length);
    let [from, behind] = [0, 0];
    while (from < most && old[from] === text[from]) ++from;
    while (behind < most - from && old.at(-1 - behind) === text.at(-1 - behind)) ++behind;
    this.view.dispatch({ changes: { from, to: old.length - behind, insert: text.slice(from, text.length - behind) } });
  }

  /** Shows what a check found in this text. */
  mark(found) {
    this.view.dispatch({ effects: setFindings.of(found) });
  }

  /** Shows the breakpoints. @param blocks a Set of numbers */
  showBreaks(blocks) {
    this.view.dispatch({ effects: setBreaks.of(blocks) });
  }

  /** Shows the line the machine is at. Only the text scrolls: the page stays under the finger. */
  showLine(line) {
    this.view.dispatch({ effects: setHere.of(line) });
    if (line >= 1 && line <= this.view.state.doc.lines) this.#reveal(line);
  }

  /** Puts the cursor where a finding is. */
  goTo({ line, column }) {
    const { doc } = this.view.state;
    const place = doc.line(Math.min(Math.max(line, 1), doc.lines));
    this.view.dispatch({ selection: { anchor: Math.min(place.from + Math.max(column - 1, 0), place.to) } });
    this.#reveal(place.number);
    this.view.focus();
  }

  #reveal(line) {
    const { top, bottom } = this.view.lineBlockAt(this.view.state.doc.line(line).from);
    const scroller = this.view.scrollDOM;
    if (top >= scroller.scrollTop && bottom <= scroller.scrollTop + scroller.clientHeight) return;
    scroller.scrollTop = top - scroller.clientHeight / 2;
  }

  destroy() {
    this.view.destroy();
  }
}
