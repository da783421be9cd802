/** German of the views at a desk. */
export default {
  'overview.look': 'Gezeigt als',
  'overview.look.list': 'Liste',
  'overview.look.heat': 'Teile nach Merkmal',
  'overview.look.wall': 'Kleine Karten',
  'heat.browse': 'Teile nach Merkmal: die Pfeiltasten gehen von Wert zu Wert',
  'heat.pick': 'Ein Feld berühren oder die Pfeiltasten benutzen. Das neueste Teil steht rechts.',
  'heat.table': 'Dasselbe als Tabelle',
  'heat.none': 'nicht gemessen',
  'heat.upper': 'nahe der oberen Grenze',
  'heat.middle': 'in der Mitte',
  'heat.lower': 'nahe der unteren Grenze',
  'wall.title': 'Kleine Karten der neuesten Werte',
};
