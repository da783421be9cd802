/** Klartext as the editor colours it: words, axes, parameters, numbers, comments. */

import { HighlightStyle, StreamLanguage, syntaxHighlighting, tags } from '../bundled/codemirror.js';

/** What stands in a line, in the order in which it is tried; what nothing fits is text. */
const TOKENS = [
  [/^\s+/, null],
  [/^;.*/, 'comment'],
  [/^"[^"]*"?/, 'string'],
  [/^[+-]?Q[LRS]?\d+/i, 'variableName'],
  [/^(?:[XYZABCUVWIR]|PR|PA|DL|DR|IX|IY|IZ)(?=\s?[+-]?\s?(?:\d|\.|Q))/i, 'propertyName'],
  [/^(?:M|F|S|N)(?=\d)/i, 'atom'],
  [/^[+-]?\d*[.,]?\d+/, 'number'],
  [/^[A-Z_][\w-]*/i, 'keyword'],
  [/^./, null],
];

const language = StreamLanguage.define({
  name: 'klartext',
  token(stream) {
    if (stream.sol() && stream.match(/^\s*\d+(?=\s)/)) return 'meta';
    if (stream.match(/^\*\s*-.*/)) return 'heading';
    return TOKENS.find(([pattern]) => stream.match(pattern))[1];
  },
  languageData: { commentTokens: { line: ';' } },
});

/** Whether the blocks of a text have numbers of their own. */
export const isNumbered = (text) => /^(?:.*\n)?\s*N?\d+\s/.test(text);

const numbers = new WeakMap();
/** The number of the block that begins in each line of a document, as the control counts; '' where none does. */
export function blockNumbers(doc) {
  if (numbers.has(doc)) return numbers.get(doc);
  let next = 0;
  let goesOn = false;
  const found = doc.toString().split('\n').map((text) => {
    const begins = !goesOn && text.trim() !== '';
    goesOn = /~\s*$/.test(text);
    if (!begins) return '';
    const written = /^\s*\/?\s*(\d+)/.exec(text)?.[1];
    next = Number(written ?? next) + 1;
    return String(next - 1);
  });
  numbers.set(doc, found);
  return found;
}

const colours = HighlightStyle.define([
  { tag: tags.comment, color: 'var(--soft)' },
  { tag: tags.meta, color: 'var(--soft)' },
  { tag: tags.string, color: 'var(--code-text)' },
  { tag: tags.variableName, color: 'var(--code-parameter)' },
  { tag: tags.keyword, color: 'var(--focus)' },
  { tag: tags.atom, color: 'var(--focus)' },
  { tag: tags.propertyName, fontWeight: '600' },
  { tag: tags.heading, fontWeight: '600' },
]);

export const klartext = [language, syntaxHighlighting(colours)];
