/** A list whose rows are put in another order: dragged by their grip, or moved by the arrow keys on it. */

import { h, s } from '../dom.js';

const ICONS = {
  grip: 'M9 5v.01M15 5v.01M9 12v.01M15 12v.01M9 19v.01M15 19v.01', more: 'M5 12v.01M12 12v.01M19 12v.01',
  copy: 'M9 9h11v11H9zM5 15H4V4h11v1', remove: 'M5 7h14M10 7V4h4v3M7 7l1 13h8l1-13',
};
/** A drag this near to an end of the window moves the page. */
const EDGE_PX = 60;

/** A button that shows a sign, with its words for those who hear it. */
export const iconButton = (icon, label, attributes) => h(`button.icon.${icon}`, { type: 'button', 'aria-label': label, title: label, ...attributes },
  s('svg', { viewBox: '0 0 24 24', 'aria-hidden': 'true' }, s('path', { d: ICONS[icon] })));

/** Moves a row to a place among its siblings. @returns whether it has moved */
function place(row, at) {
  const list = row.parentElement;
  const others = [...list.children].filter((each) => each !== row);
  const next = others[Math.min(Math.max(at, 0), others.length)] ?? null;
  if (row.nextElementSibling === next) return false;
  list.insertBefore(row, next);
  return true;
}

const KEYS = { ArrowUp: (at) => at - 1, ArrowDown: (at) => at + 1, Home: () => 0, End: () => Infinity };

/** @param onMoved is told of the row that stands elsewhere now */
export function sortable(list, onMoved) {
  list.addEventListener('keydown', (event) => {
    const grip = event.target.closest('.grip');
    if (!grip || !KEYS[event.key]) return;
    event.preventDefault();
    const row = grip.closest('li');
    if (!place(row, KEYS[event.key]([...list.children].indexOf(row)))) return;
    grip.focus();
    onMoved(row);
  });
  list.addEventListener('pointerdown', (event) => {
    const grip = event.target.closest('.grip');
    if (!grip || event.button) return;
    event.preventDefault();
    grip.focus();
    drag(list, grip.closest('li'), onMoved);
  });
}

function drag(list, row, onMoved) {
  const ending = new AbortController();
  let moved = false;
  row.classList.add('moving');
  const follow = ({ clientY }) => {
    const others = [...list.children].filter((each) => each !== row);
    const at = others.filter((each) => {
      const { top, height } = each.getBoundingClientRect();
      return top + height / 2 < clientY;
    }).length;
    moved = place(row, at) || moved;
    if (clientY < EDGE_PX) scrollBy(0, -EDGE_PX / 4);
    if (clientY > innerHeight - EDGE_PX) scrollBy(0, EDGE_PX / 4);
  };
  const end = () => {
    ending.abort();
    row.classList.remove('moving');
    row.querySelector('.grip').focus();
    if (moved) onMoved(row);
  };
  addEventListener('pointermove', follow, { signal: ending.signal });
  for (const name of ['pointerup', 'pointercancel']) addEventListener(name, end, { signal: ending.signal });
}
