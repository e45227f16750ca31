/** The unit in which lengths are shown. What is stored, shared and computed is in millimetres all the same. */

const KEY = 'unit';
const MM = 25.4;

/** @returns {boolean} */
function preferred() {
  try {
    return localStorage.getItem(KEY) === 'inch';
  } catch {
    return false;
  }
}

export const isInch = preferred();

/** Goes over to the other unit; the work is kept. */
export function switchUnit() {
  try {
    localStorage.setItem(KEY, isInch ? 'mm' : 'inch');
  } catch {
    return;
  }
  location.reload();
}

/** What a number in this unit is multiplied by to be shown, and the unit that it then has. @type {Record<string, [number, string]>} */
const INCHES = {
  mm: [1 / MM, 'in'],
  'mm/min': [1 / MM, 'in/min'],
  'mm²': [1 / (MM * MM), 'in²'],
  '°/mm': [MM, '°/in'],
};

/** @param {string | undefined} unit @returns {[number, string]} The factor, and the unit that is shown. */
export const shownIn = (unit = '') => (isInch && INCHES[unit]) || [1, unit];
