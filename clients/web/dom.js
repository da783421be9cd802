/** Elements without markup text: whatever is shown is set as text. */

const SVG = 'http://www.w3.org/2000/svg';

function fill(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? '' : String(value));
  }
  element.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined && child !== false));
  return element;
}

function make(create, selector, rest) {
  const [name, ...classes] = selector.split('.');
  const element = create(name || 'div');
  if (classes.length) element.setAttribute('class', classes.join(' '));
  const [first] = rest;
  const plain = first && Object.getPrototypeOf(first) === Object.prototype;
  return fill(element, plain ? first : {}, plain ? rest.slice(1) : rest);
}

/** h('button.primary', {type: 'button', onclick}, 'Judge') */
export const h = (selector, ...rest) => make((name) => document.createElement(name), selector, rest);

/** The same for SVG. */
export const s = (selector, ...rest) => make((name) => document.createElementNS(SVG, name), selector, rest);

const FOCUSED = 'a, button, input, select, summary, textarea, [tabindex]';
const sameAs = (element) => [element.tagName, element.id, element.name, element.getAttribute('aria-label'), element.textContent].join();

/** Puts other children into an element; what had the focus and is there again keeps it. */
export function refill(element, ...children) {
  const focused = element.contains(document.activeElement) && document.activeElement;
  const sign = focused && focused !== element && sameAs(focused);
  element.replaceChildren(...children.flat(Infinity).filter(Boolean));
  if (sign) [...element.querySelectorAll(FOCUSED)].find((each) => sameAs(each) === sign)?.focus();
}

/** A labelled form control. */
export function field(label, control, hint) {
  return h('label.field', h('span.label', label), control, hint && h('span.hint', hint));
}

let serial = 0;
/** An id no other element has. */
export const freshId = (stem) => `${stem}-${++serial}`;

/** Puts text on the clipboard; without the clipboard interface (plain HTTP) through a selection. */
export async function copyText(text) {
  if (navigator.clipboard) return navigator.clipboard.writeText(text);
  const area = h('textarea.unseen', { value: text, readonly: true });
  document.body.append(area);
  area.value = text;
  area.select();
  document.execCommand('copy');
  area.remove();
}
