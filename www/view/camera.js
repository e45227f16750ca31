/** The camera: standard views, fitting, and the keys. */
import { Box3, OrthographicCamera, PerspectiveCamera, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { inside, meet, rooms } from './room.js';

/** A long lens: little distortion, so that parallel passes look parallel. */
const FIELD_OF_VIEW_DEG = 24;
const TURN_RAD = Math.PI / 36;
const ZOOM = 1.12;
/** Pixels between what is shown and the controls around it. */
const MARGIN = 20;
const CENTRE = { x: 0.5, y: 0.5 };

/** Where each view looks from; z is up. @type {Record<string, [number, number, number]>} */
const FROM = {
  iso: [-0.62, -1, 0.78],
  top: [0, -0.0001, 1],
  bottom: [0, -0.0001, -1],
  front: [0, -1, 0.0001],
  back: [0, 1, 0.0001],
  left: [-1, 0, 0.0001],
  right: [1, 0, 0.0001],
};

/**
 * @param {HTMLCanvasElement} canvas
 * @param {() => import('./room.js').Room[]} covered What controls cover of it.
 * @param {() => void} onChange
 */
export function createCamera(canvas, covered, onChange) {
  const lens = new PerspectiveCamera(FIELD_OF_VIEW_DEG, 1, 1, 1000);
  /** Without perspective: lengths can be compared. */
  const parallel = new OrthographicCamera(-1, 1, 1, -1, 1, 1000);
  /** The one in use. @type {PerspectiveCamera | OrthographicCamera} */
  let camera = lens;
  for (const one of [lens, parallel]) one.up.set(0, 0, 1);
  const controls = new OrbitControls(camera, canvas);
  controls.addEventListener('change', onChange);
  controls.zoomToCursor = true;
  const box = new Box3(new Vector3(-50, -50, -10), new Vector3(50, 50, 10));
  const size = { width: 1, height: 1 };
  /** Where in the picture the box is shown, and the middle of that in parts of its sides. @type {import('./room.js').Room | null} */
  let room = null;
  let middle = CENTRE;
  let isDown = false;
  /** From where a fitted picture is looked at, until somebody turns it. @type {Vector3 | null} */
  let standing = direction('iso');
  controls.addEventListener('start', () => {
    standing = null;
  });

  /** The oblique view is from the side that is cut. @param {string} view */
  function direction(view) {
    const [x, y, z] = FROM[view];
    return new Vector3(x, y, view === 'iso' && isDown ? -z : z);
  }

  /** Looks along a direction from as near as the whole box allows, shown where there is most room for it. @param {Vector3} from */
  function fit(from) {
    const centre = box.getCenter(new Vector3());
    const radius = box.getSize(new Vector3()).length() / 2;
    camera.position.copy(centre).add(from);
    camera.lookAt(centre);
    camera.updateMatrixWorld();
    const [right, up, back] = [new Vector3(), new Vector3(), new Vector3()];
    camera.matrixWorld.extractBasis(right, up, back);
    const half = Math.tan((lens.fov * Math.PI) / 360);
    const ends = corners(box).map((corner) => {
      corner.sub(centre);
      return { x: Math.abs(corner.dot(right)), y: Math.abs(corner.dot(up)), z: corner.dot(back) };
    });
    const perPixel = (2 * half) / size.height;
    const places = rooms(size, covered()).map((room) => {
      const wide = perPixel * Math.max((room.right - room.left) / 2 - MARGIN, 1);
      const tall = perPixel * Math.max((room.bottom - room.top) / 2 - MARGIN, 1);
      const distance = Math.max(...ends.map(({ x, y, z }) => z + Math.max(x / wide, y / tall)));
      return { room, distance, area: wide * tall };
    });
    const best = places.reduce((a, b) =>
      b.distance < a.distance || (b.distance === a.distance && b.area > a.area) ? b : a,
    );
    const { distance } = best;
    room = best.room;
    middle = {
      x: (room.left + room.right) / 2 / size.width,
      y: (room.top + room.bottom) / 2 / size.height,
    };
    controls.target.copy(centre);
    camera.position.copy(centre).addScaledVector(back, distance);
    for (const one of [lens, parallel]) {
      one.near = one === parallel ? distance - 20 * radius : distance / 100;
      one.far = distance + 20 * radius;
    }
    controls.minDistance = radius / 50;
    controls.maxDistance = distance * 8;
    parallel.zoom = 1;
    shape(distance);
    controls.update();
    onChange();
  }

  /** Fits the projections to the canvas; without perspective the picture is as large as the lens shows it from `distance`. @param {number} distance */
  function shape(distance) {
    const aspect = size.width / size.height;
    lens.aspect = aspect;
    const tall = Math.tan((lens.fov * Math.PI) / 360) * distance;
    Object.assign(parallel, { left: -tall * aspect, right: tall * aspect, top: tall, bottom: -tall });
    offset();
  }

  /** Puts the middle of what is looked at where it belongs in the picture. */
  function offset() {
    const { width, height } = size;
    const [x, y] = [(0.5 - middle.x) * width, (0.5 - middle.y) * height];
    for (const one of [lens, parallel]) one.setViewOffset(width, height, x, y, width, height);
  }

  canvas.addEventListener('keydown', (event) => {
    /** @type {Record<string, () => void>} */
    const keys = {
      ArrowLeft: () => turn(-TURN_RAD, 0),
      ArrowRight: () => turn(TURN_RAD, 0),
      ArrowUp: () => turn(0, -TURN_RAD),
      ArrowDown: () => turn(0, TURN_RAD),
      '+': () => zoom(1 / ZOOM),
      '=': () => zoom(1 / ZOOM),
      '-': () => zoom(ZOOM),
    };
    const act = event.ctrlKey || event.metaKey || event.altKey ? undefined : keys[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });

  /** @param {number} around @param {number} over */
  function turn(around, over) {
    standing = null;
    const arm = camera.position.clone().sub(controls.target);
    const angle = Math.acos(Math.max(-1, Math.min(1, arm.z / arm.length())));
    const next = Math.max(0.001, Math.min(Math.PI - 0.001, angle + over));
    const flat = Math.atan2(arm.y, arm.x) + around;
    arm
      .setFromSphericalCoords(arm.length(), next, 0)
      .set(
        arm.length() * Math.sin(next) * Math.cos(flat),
        arm.length() * Math.sin(next) * Math.sin(flat),
        arm.length() * Math.cos(next),
      );
    camera.position.copy(controls.target).add(arm);
    controls.update();
    onChange();
  }

  /** @param {number} factor */
  function zoom(factor) {
    standing = null;
    if (camera === parallel) {
      parallel.zoom /= factor;
      parallel.updateProjectionMatrix();
    } else camera.position.sub(controls.target).multiplyScalar(factor).add(controls.target);
    controls.update();
    onChange();
  }

  return {
    get camera() {
      return camera;
    },

    /** With perspective or without; what is seen stays as large. @param {boolean} isParallel */
    project(isParallel) {
      const next = isParallel ? parallel : lens;
      if (next === camera) return;
      const arm = camera.position.clone().sub(controls.target);
      if (isParallel) {
        parallel.zoom = 1;
        shape(arm.length());
      } else
        arm.divideScalar(
          parallel.zoom * (arm.length() / (parallel.top / Math.tan((lens.fov * Math.PI) / 360))),
        );
      next.position.copy(controls.target).add(arm);
      camera = next;
      controls.object = /** @type {PerspectiveCamera} */ (next);
      controls.update();
      onChange();
    },

    /** Names the box that views show, and whether what is cut looks down. @param {Box3} next @param {boolean} down */
    frame(next, down) {
      isDown = down;
      if (!next.isEmpty()) box.copy(next);
    },

    /** @param {string} view 'fit' keeps the direction. */
    look(view) {
      standing = FROM[view] ? direction(view) : camera.position.clone().sub(controls.target);
      fit(standing);
    },

    /** Fits again where controls have come to cover much of what was fitted: not for a line more or less. */
    settle() {
      const place = room && inside(room, 2 * MARGIN);
      if (standing && place && covered().some((control) => meet(place, control))) fit(standing);
    },

    /** Draws once with what is fitted in the middle: where no controls are, nothing is to keep clear of them. @param {() => void} draw */
    centred(draw) {
      const kept = middle;
      if (standing) middle = CENTRE;
      offset();
      draw();
      middle = kept;
      offset();
    },

    /** @param {number} width @param {number} height */
    resize(width, height) {
      Object.assign(size, { width, height });
      shape(parallel.top / Math.tan((lens.fov * Math.PI) / 360));
      if (standing) fit(standing);
    },
  };
}

/** @param {Box3} box */
function corners({ min, max }) {
  return [min.x, max.x].flatMap((x) =>
    [min.y, max.y].flatMap((y) => [min.z, max.z].map((z) => new Vector3(x, y, z))),
  );
}
