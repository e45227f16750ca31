/** Where the picture has room between the controls over it. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { rooms } from '../../www/view/room.js';

const SIZE = { width: 600, height: 700 };
const bar = { left: 10, top: 10, right: 590, bottom: 80 };
const legend = { left: 10, top: 530, right: 280, bottom: 650 };
const has = (found, room) =>
  found.some((one) => Object.entries(room).every(([side, at]) => one[side] === at));

test('without controls there is the whole picture', () => {
  assert.deepEqual(rooms(SIZE, []), [{ left: 0, top: 0, right: 600, bottom: 700 }]);
});

test('rooms reach above a control and beside it, and none of them meets one', () => {
  const found = rooms(SIZE, [bar, legend]);
  assert.ok(has(found, { left: 0, top: 80, right: 600, bottom: 530 }));
  assert.ok(has(found, { left: 280, top: 80, right: 600, bottom: 700 }));
  for (const { left, top, right, bottom } of found) {
    for (const control of [bar, legend]) {
      assert.ok(
        right <= control.left || left >= control.right || bottom <= control.top || top >= control.bottom,
      );
    }
  }
});

test('what lies outside the picture, or partly, makes no room there', () => {
  const aside = { left: -300, top: 20, right: -220, bottom: 90 };
  const reaching = { left: -50, top: 600, right: 200, bottom: 900 };
  for (const { left, top, right, bottom } of rooms(SIZE, [aside, reaching])) {
    assert.ok(left >= 0 && top >= 0 && right <= SIZE.width && bottom <= SIZE.height);
  }
  assert.ok(has(rooms(SIZE, [aside, reaching]), { left: 200, top: 0, right: 600, bottom: 700 }));
});

test('where controls leave no room, they lie over the picture', () => {
  const covered = [{ left: 0, top: 50, right: 600, bottom: 650 }];
  assert.deepEqual(rooms(SIZE, covered), [{ left: 0, top: 0, right: 600, bottom: 700 }]);
});
