/** Dutch of the views at a desk. */
export default {
  'overview.look': 'Getoond als',
  'overview.look.list': 'Lijst',
  'overview.look.heat': 'Onderdelen per kenmerk',
  'overview.look.wall': 'Kleine kaarten',
  'heat.browse': 'Onderdelen per kenmerk: de pijltoetsen gaan van waarde naar waarde',
  'heat.pick': 'Raak een vak aan, of gebruik de pijltoetsen. Het nieuwste onderdeel staat rechts.',
  'heat.table': 'Hetzelfde als tabel',
  'heat.none': 'niet gemeten',
  'heat.upper': 'bij de bovengrens',
  'heat.middle': 'in het midden',
  'heat.lower': 'bij de ondergrens',
  'wall.title': 'Kleine kaarten van de nieuwste waarden',
};
