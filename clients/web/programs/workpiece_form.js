/** The workpiece of a setup as a form: its features, one card each. The setup's text stays what is run and stored. */

import { h, refill } from '../dom.js';
import { has, t } from '../i18n.js';
import { resolved, SchemaForm, schemas } from '../schema_form.js';

const kindOf = (schema) => schema.properties.type.const;
const kindText = (kind) => (has(`feature.${kind}`) ? t(`feature.${kind}`) : kind);

/** What a new feature begins with: something one sees at once. */
const BEGIN = {
  block: { min_mm: [0, 0, -40], max_mm: [100, 80, 0] }, bore: { center_mm: [50, 40], diameter_mm: 25.013 },
  boss: { center_mm: [50, 40], diameter_mm: 25 }, plane: {}, sphere: { center_mm: [60, 25, 40], diameter_mm: 30 },
  surface: { points_mm: [[0, 0, 0], [100, 0, 0], [0, 80, 0], [100, 80, 0]] }, mesh: { file: '' },
};

export class WorkpieceForm {
  /** @param onChange takes the features as they are now */
  constructor(onChange) {
    this.onChange = onChange;
    this.cards = h('div.features', { oninput: () => this.#changed() });
    this.kind = h('select', { 'aria-label': t('feature.kind') });
    this.element = h('section.workpiece', { 'aria-label': t('feature.title') }, h('h3', t('feature.title')), this.cards,
      h('p.line', this.kind, h('button', { type: 'button', onclick: () => this.#add() }, t('feature.add'))));
    this.forms = [];
    this.element.hidden = true;
  }

  /** Shows the features of a setup. @throws Problem where the service does not say what they have */
  async show(features = []) {
    this.all ??= await schemas();
    this.kinds ??= new Map(this.all.Feature.oneOf.map((one) => resolved(one, this.all)).map((schema) => [kindOf(schema), schema]));
    if (!this.kind.options.length) this.kind.append(...[...this.kinds.keys()].map((kind) => h('option', { value: kind }, kindText(kind))));
    this.forms = features.map((feature) => this.#form(feature));
    this.element.hidden = false;
    this.#draw();
  }

  /** A feature of a kind that is not known stays as it is. */
  #form(feature) {
    const schema = this.kinds.get(feature?.type);
    return schema ? new SchemaForm(schema, this.all, 'schema').fill(feature) : { value: feature, element: h('p.aside', t('feature.unknown')) };
  }

  #add() {
    this.forms.push(this.#form({ type: this.kind.value, ...BEGIN[this.kind.value] }));
    this.#draw();
    this.#changed();
  }

  #remove(form) {
    this.forms = this.forms.filter((other) => other !== form);
    this.#draw();
    this.#changed();
  }

  #changed() {
    this.onChange(this.forms.map(({ value }) => value));
  }

  #draw() {
    refill(this.cards, this.forms.map((form, i) => {
      const name = kindText(form.value?.type);
      return h('fieldset.feature', h('legend', `${i + 1}. ${name}`), form.element,
        h('button.quiet', { type: 'button', 'aria-label': t('feature.remove_this', { name: `${i + 1}. ${name}` }), onclick: () => this.#remove(form) }, t('feature.remove')));
    }));
  }
}
