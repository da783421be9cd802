/** The fits a designer tries first, as ANSI B4.2 lists them, on the hole and on the shaft basis. */

import { h } from '../dom.js';
import { t } from '../i18n.js';

const PREFERRED = [
  ['loose', 'H11/c11', 'C11/h11'], ['free', 'H9/d9', 'D9/h9'], ['close', 'H8/f7', 'F8/h7'],
  ['sliding', 'H7/g6', 'G7/h6'], ['location', 'H7/h6', 'H7/h6'], ['transition', 'H7/k6', 'K7/h6'],
  ['tight', 'H7/n6', 'N7/h6'], ['press', 'H7/p6', 'P7/h6'], ['drive', 'H7/s6', 'S7/h6'], ['force', 'H7/u6', 'U7/h6'],
];

/** @param onPick takes {hole, shaft} */
export function preferredFits(current, onPick) {
  const pick = (fit) => {
    const [hole, shaft] = fit.split('/');
    return h('button', {
      type: 'button', 'aria-pressed': String(fit === `${current.hole}/${current.shaft}`), onclick: () => onPick({ hole, shaft }),
    }, fit);
  };
  return h('section.preferred', h('h2', t('fit.preferred')),
    h('ul', PREFERRED.map(([name, hole, shaft]) => h('li', h('span.aside', t(`fit.kind.${name}`)),
      pick(hole), shaft !== hole && pick(shaft)))));
}
