/** A program's text with line numbers; what a check found stands below the line it is about. */

import { h } from '../dom.js';
import { findingText, t } from '../i18n.js';
import { relative } from './disk.js';

const MOST_LINES = 3000;

/** @param onLine takes the number of a line that was touched */
export function sourceText(path, text, diagnostics, onLine) {
  const lines = text.replace(/\r?\n$/, '').split(/\r?\n/);
  const own = diagnostics.filter((each) => relative(each.program).toLowerCase() === path.toLowerCase());
  const others = diagnostics.filter((each) => !own.includes(each));
  return [
    others.length > 0 && h('ul.elsewhere', others.map((each) => h('li', finding(each),
      h('p.aside', `${each.program} · ${t('programs.line', { line: each.line })}`), h('code', each.source)))),
    h('ol.source', { tabindex: 0, 'aria-label': path }, lines.slice(0, MOST_LINES).map((line, i) => {
      const here = own.filter((each) => each.line === i + 1);
      return h('li', { onclick: () => onLine(i + 1), class: here.length ? here[0].severity : '' }, h('code', line || ' '),
        here.map((each) => [h('code.caret', { 'aria-hidden': 'true' }, `${' '.repeat(each.column - 1)}^`), finding(each)]));
    })),
    lines.length > MOST_LINES && h('p.aside', t('programs.cut', { count: lines.length - MOST_LINES })),
  ].filter(Boolean);
}

const finding = (each) => h('p', { class: `finding ${each.severity}` },
  h('strong', t(`programs.severity.${each.severity}`)), ` ${findingText(each)} `,
  findingText(each) !== each.message && h('span.aside', { lang: 'en' }, each.message), h('span.aside', each.code));
