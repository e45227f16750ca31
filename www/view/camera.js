/** The camera: standard views, fitting, and the keys. */
import { Box3, PerspectiveCamera, Sphere, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

/** A long lens: little distortion, so that parallel passes look parallel. */
const FIELD_OF_VIEW_DEG = 24;
const TURN_RAD = Math.PI / 36;
const ZOOM = 1.12;

/** Where each view looks from; z is up. @type {Record<string, [number, number, number]>} */
const FROM = { iso: [-0.62, -1, 0.78], top: [0, -0.0001, 1], front: [0, -1, 0.0001] };

/**
 * @param {HTMLCanvasElement} canvas
 * @param {() => void} onChange
 */
export function createCamera(canvas, onChange) {
  const camera = new PerspectiveCamera(FIELD_OF_VIEW_DEG, 1, 1, 1000);
  camera.up.set(0, 0, 1);
  const controls = new OrbitControls(camera, canvas);
  controls.addEventListener('change', onChange);
  controls.zoomToCursor = true;
  const sphere = new Sphere(new Vector3(), 50);

  /** Moves the camera along its line of sight, or to a new one, until the whole sphere is seen. @param {Vector3} from */
  function fit(from) {
    const half = (camera.fov * Math.PI) / 360;
    const across = Math.atan(Math.tan(half) * Math.min(camera.aspect, 1));
    const distance = (sphere.radius / Math.sin(across)) * 0.92;
    controls.target.copy(sphere.center);
    camera.position.copy(sphere.center).addScaledVector(from.normalize(), distance);
    camera.near = distance / 100;
    camera.far = distance * 20;
    controls.minDistance = sphere.radius / 50;
    controls.maxDistance = distance * 8;
    camera.updateProjectionMatrix();
    controls.update();
    onChange();
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
    camera.position.sub(controls.target).multiplyScalar(factor).add(controls.target);
    controls.update();
    onChange();
  }

  return {
    camera,

    /** @param {Box3} box */
    frame(box) {
      if (box.isEmpty()) return;
      box.getBoundingSphere(sphere);
    },

    /** @param {string} view 'fit' keeps the direction. */
    look(view) {
      const from = FROM[view];
      fit(from ? new Vector3(...from) : camera.position.clone().sub(controls.target));
    },

    /** @param {number} width @param {number} height */
    resize(width, height) {
      camera.aspect = width / height;
      camera.updateProjectionMatrix();
    },
  };
}
