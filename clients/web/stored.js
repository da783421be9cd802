/** What the browser keeps for the page. A browser that keeps nothing only forgets. */

const name = (key) => `fitgauge.${key}`;

export function store(key, value, place = localStorage) {
  try {
    place.setItem(name(key), value);
    return true;
  } catch {
    return false;
  }
}

export function readStored(key, place = localStorage) {
  try {
    return place.getItem(name(key));
  } catch {
    return null;
  }
}

export function forget(key, place = localStorage) {
  try {
    place.removeItem(name(key));
  } catch {
    // there was nothing
  }
}

/** The keys that begin with a prefix, in order. */
export function storedKeys(prefix, place = localStorage) {
  try {
    return Object.keys(place)
      .filter((key) => key.startsWith(name(prefix)))
      .map((key) => key.slice(name('').length))
      .sort();
  } catch {
    return [];
  }
}
