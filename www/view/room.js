/**
 * Where in the picture there is room: between the controls that lie over it.
 *
 * @typedef {{ left: number, top: number, right: number, bottom: number }} Room Pixels from the upper left corner.
 */

/** A room narrower or lower than this shows nothing, pixels. */
const LEAST = 100;

/** A room, smaller by so much on all sides. @param {Room} room @param {number} by @returns {Room} */
export const inside = ({ left, top, right, bottom }, by) => ({
  left: left + by,
  top: top + by,
  right: right - by,
  bottom: bottom - by,
});

/**
 * All rooms that end at controls or at the border of the picture and that none of them covers; the whole picture where there is none.
 *
 * @param {{ width: number, height: number }} size
 * @param {Room[]} covered What controls cover.
 * @returns {Room[]}
 */
export function rooms({ width, height }, covered) {
  const whole = { left: 0, top: 0, right: width, bottom: height };
  const over = covered.filter((control) => meet(control, whole));
  const within = (/** @type {number} */ at, /** @type {number} */ most) => Math.min(Math.max(at, 0), most);
  const lefts = [0, ...over.map(({ right }) => within(right, width))];
  const rights = [width, ...over.map(({ left }) => within(left, width))];
  const tops = [0, ...over.map(({ bottom }) => within(bottom, height))];
  const bottoms = [height, ...over.map(({ top }) => within(top, height))];
  const open = lefts
    .flatMap((left) => rights.map((right) => ({ left, right })))
    .filter(({ left, right }) => right - left >= LEAST)
    .flatMap((across) => tops.flatMap((top) => bottoms.map((bottom) => ({ ...across, top, bottom }))))
    .filter((room) => room.bottom - room.top >= LEAST && !over.some((control) => meet(room, control)));
  return open.length ? open : [whole];
}

/** Whether two have some of the picture in common. @param {Room} a @param {Room} b */
export const meet = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
