/** What a check found: first what is wrong elsewhere, then each place of the program, which a touch goes to. */

import { h } from '../dom.js';
import { findingText, t } from '../i18n.js';

/** @param own findings of the program that is open; @param others of those it calls; @param onGo takes a finding */
export const findingList = (own, others, onGo) => [
  ...others.map((each) => h('li', said(each), h('p.aside', each.program), h('code', each.source))),
  ...own.map((each) => h('li', h('button.quiet', { type: 'button', onclick: () => onGo(each) }, t('programs.line', { line: each.line })), said(each))),
];

const said = (each) => h('p', { class: `finding ${each.severity}` },
  h('strong', t(`programs.severity.${each.severity}`)), ` ${findingText(each)} `,
  findingText(each) !== each.message && h('span.aside', { lang: 'en' }, each.message), h('span.aside', each.code));
