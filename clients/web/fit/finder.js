/** Fits whose clearances lie within what the function of a joint allows. */

import { getJson, url } from '../api.js';
import { field, h, refill } from '../dom.js';
import { nmFromUm, parseSigned, umText } from '../exact.js';
import { explain, number, signed, t } from '../i18n.js';
import { Latest } from '../latest.js';

const MOST = 12;

export class Finder {
  /** @param sizeOf gives the nominal size as text; @param onPick takes {hole, shaft} */
  constructor({ leaving, sizeOf, onPick }) {
    Object.assign(this, { sizeOf, onPick, latest: new Latest(leaving) });
    this.inputs = ['least', 'greatest'].map((name) => h('input', { type: 'text', inputmode: 'text', autocomplete: 'off', id: `find-${name}` }));
    this.note = h('p.found-note', { role: 'status' });
    this.list = h('ul.found');
    this.element = h('section.finder', h('h2', t('find.title')),
      h('form.line', { novalidate: true, onsubmit: (event) => { event.preventDefault(); this.#find(); } },
        field(t('find.least'), this.inputs[0]), field(t('find.greatest'), this.inputs[1]),
        h('button', { type: 'submit' }, t('find.find'))),
      h('p.aside', t('find.hint')), this.note, this.list);
  }

  /** Another size: what was found is of the one before. */
  clear() {
    this.note.textContent = '';
    this.list.replaceChildren();
  }

  async #find() {
    this.clear();
    const [least, greatest] = this.inputs.map((input) => parseSigned(input.value.trim()));
    if (least === null || greatest === null) {
      this.note.textContent = t('find.numbers');
      return;
    }
    try {
      const found = await this.latest.run((signal) => getJson(url(['fits'], {
        nominal_mm: this.sizeOf(), min_clearance_um: least, max_clearance_um: greatest, limit: MOST }), { signal }));
      if (!found) return;
      this.note.textContent = found.total ? t('find.found', { shown: found.fits.length, total: found.total }) : t('find.none');
      refill(this.list, found.fits.map((fit) => this.#item(fit)));
    } catch (problem) {
      this.note.textContent = explain(problem);
    }
  }

  #item({ hole_class: hole, shaft_class: shaft, preferred, min_clearance_um: least, max_clearance_um: most }) {
    const um = (value) => signed(umText(nmFromUm(value)));
    return h('li', h('button', { type: 'button', onclick: () => this.onPick({ hole, shaft }) }, `${hole}/${shaft}`),
      h('span', `${um(least)} … ${um(most)} µm`), preferred && h('span.aside', t('find.preferred')));
  }
}

/** "⌀25 H7 (+0.021/0)": how a drawing has a size, with the minus of a keyboard, which every CAD system reads. */
export function drawingText(limits, mm) {
  const deviation = (um) => (nmFromUm(um) === 0 ? '0' : signed(mm(nmFromUm(um))));
  return `⌀${number(limits.nominal_mm)} ${limits.tolerance_class} (${deviation(limits.upper_deviation_um)}/${deviation(limits.lower_deviation_um)})`.replaceAll('−', '-');
}
