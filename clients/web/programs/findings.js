/** What a check found: first what is wrong elsewhere, then each place of the program, which a touch goes to. */

import { h } from '../dom.js';
import { findingText, t } from '../i18n.js';
import { fileName } from './disk.js';

/** Where something is, as the control counts it: the block, or the line of a text whose blocks have no numbers. */
export const placeText = ({ block, line }) => (Number.isInteger(block) ? t('programs.at_block', { block }) : t('programs.line', { line }));

/** @param own findings of the program that is open; @param others of those it calls; @param onGo takes a finding */
export const findingList = (own, others, onGo) => [
  ...others.map((each) => h('li', said(each), h('p.aside', `${fileName(each.program)} · ${placeText(each)}`), h('code', each.source))),
  ...own.map((each) => h('li', h('button.quiet', { type: 'button', onclick: () => onGo(each) }, placeText(each)), said(each))),
];

const said = (each) => h('p', { class: `finding ${each.severity}` },
  h('strong', t(`programs.severity.${each.severity}`)), ` ${findingText(each)} `,
  findingText(each) !== each.message && h('span.aside', { lang: 'en' }, each.message), h('span.aside', each.code));
