/** Every class of a size in one grade, from A to ZC: a choice by letter, drawn as tolerance zones. */

import { freshId, h, s } from '../dom.js';
import { nmFromUm } from '../exact.js';
import { signed, t } from '../i18n.js';
import { isoClass, rowOf, tableRows } from '../tables/catalogue.js';

const HEIGHT = 160;

export class ClassMap {
  /** @param onPick takes the name of a class; @param onProblem why those of another grade are not shown */
  constructor(feature, names, { onPick, onProblem }) {
    this.feature = feature;
    this.names = names;
    this.onPick = onPick;
    this.group = freshId(feature);
    this.grade = h('select', { onchange: () => this.show(this.size, this.chosen, this.grade.value).catch(onProblem) },
      [...new Set(names.map((name) => isoClass(name)?.grade).filter(Boolean))].map((grade) => h('option', { value: grade }, `IT${grade}`)));
    this.zones = h('div.class-zones', { role: 'radiogroup', 'aria-label': t(`fit.classes.${feature}`) });
    this.element = h('section.class-map',
      h('div.line', h('h2', t(`fit.classes.${feature}`)), h('label.inline', h('span.unseen', t('fit.grade')), this.grade)),
      this.zones);
  }

  /** Draws the classes of a size in nm. */
  async show(size, chosen, grade = isoClass(chosen)?.grade ?? this.grade.value) {
    const asked = {};
    Object.assign(this, { size, chosen, asked });
    this.grade.value = grade;
    const classes = this.names.filter((name) => isoClass(name)?.grade === grade || !isoClass(name));
    const { rows } = await tableRows(this.feature, classes);
    if (this.asked !== asked) return;
    const limits = rowOf(rows, size)?.limits ?? {};
    this.#draw(classes.filter((name) => name in limits).map((name) => ({
      name, upper: nmFromUm(limits[name].upper_um), lower: nmFromUm(limits[name].lower_um),
    })));
  }

  #draw(classes) {
    const high = Math.max(0, ...classes.map(({ upper }) => upper));
    const low = Math.min(0, ...classes.map(({ lower }) => lower));
    const y = (nm) => 8 + (HEIGHT - 16) * (high - nm) / Math.max(high - low, 1);
    const hadFocus = this.zones.contains(document.activeElement);
    this.zones.replaceChildren(...classes.map((zone) => this.#choice(zone, y)));
    const chosen = this.zones.querySelector(':checked');
    if (hadFocus) chosen?.focus();
    // Sideways only: the page itself stays where it is.
    const place = chosen?.parentElement;
    if (place) this.zones.scrollLeft = place.offsetLeft - (this.zones.clientWidth - place.offsetWidth) / 2;
  }

  #choice({ name, upper, lower }, y) {
    const input = h('input', { type: 'radio', name: this.group, value: name, onchange: () => this.#pick(name) });
    input.checked = name === this.chosen;
    return h('label', input,
      s('svg', { viewBox: `0 0 44 ${HEIGHT}`, preserveAspectRatio: 'none', 'aria-hidden': 'true' },
        s('path.zero', { d: `M0 ${y(0)}H44` }),
        s('rect', { x: 7, y: y(upper), width: 30, height: Math.max(y(lower) - y(upper), 1.5) })),
      h('span', isoClass(name)?.letters ?? name), [upper, lower].map((nm) => h('span.um', signed(nm / 1000))));
  }

  #pick(name) {
    this.chosen = name;
    this.onPick(name);
  }
}
