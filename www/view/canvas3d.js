/**
 * The picture of surface, path and cutter. A frame is drawn only when something changed.
 *
 * @import { Outcome, Removal, State } from '../types.js'
 */
import { AmbientLight, Color, DirectionalLight, Raycaster, Scene, Vector2 } from 'three';
import { runsOf } from '../comparing.js';
import { t } from '../text/index.js';
import { createNearest, hasPostures } from './along-path.js';
import { createCamera } from './camera.js';
import { createCutterModel } from './cutter-model.js';
import { h } from './dom.js';
import { createGround } from './ground.js';
import { createOtherFaces } from './other-faces.js';
import { createOverlays } from './overlays.js';
import { createPathLines } from './path-lines.js';
import { createRemoving } from './removing.js';
import { createRenderer } from './renderer.js';
import { createStartCurve } from './start-curve.js';
import { createSurfaceMesh } from './surface-mesh.js';
import { createTints } from './tint.js';
import { createViewCube } from './view-cube.js';
import { lastCut, locate, shareAt } from './way.js';
import { createZones } from './zones.js';

/** A picture that did not move for this time is at rest, milliseconds. */
const REST_MS = 300;

/** What lies in the same place as the picture, or comes and goes over it. */
const ASIDE = ['canvas', 'domain', 'notice'];

/** A pointer that moved less than this many pixels was clicking, not turning. */
const CLICK = 5;

/**
 * @param {HTMLElement} root
 * @param {{ onFace: (index: number) => void, onAt: (at: number) => void, onPoint: (point: number[]) => void,
 *   onPick: (point: number[], excess: number | null) => void }} callbacks
 */
export function createCanvas3d(root, { onFace, onAt, onPoint, onPick }) {
  const canvas = h('canvas', { tabindex: 0, 'aria-label': t('canvas.label') });
  root.append(canvas);
  const drawing = createRenderer(canvas);
  const scene = new Scene();
  const surface = createSurfaceMesh();
  const path = createPathLines();
  const cutter = createCutterModel();
  const zones = createZones();
  const others = createOtherFaces();
  const ground = createGround();
  const start = createStartCurve();
  const overlays = createOverlays();
  const tintOf = createTints();
  const view = createCamera(canvas, covered, move);
  // Lights travel with the eye: whatever is looked at is lit from above the left shoulder.
  const sky = new AmbientLight(0xffffff, 1.15);
  const key = new DirectionalLight(0xffffff, 2.4);
  key.position.set(-0.6, 0.9, 1);
  scene.add(
    sky,
    key,
    key.target,
    overlays.group,
    ground.grid,
    others.group,
    surface.group,
    path.group,
    zones.root.cubes,
    start.group,
    cutter.mesh,
  );
  let scheduled = false;
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let resting;
  /** @type {State | null} */
  let last = null;
  /** @type {Partial<State>} */
  let painted = {};
  let framed = '';
  /** What is left while the path is run, on show. @type {{ removal: Removal, removing: ReturnType<typeof createRemoving> } | null} */
  let running = null;
  const cube = createViewCube(root, (side) => view.look(side));
  /** @type {{ outcome: Outcome | null, nearest: ReturnType<typeof createNearest> | null }} */
  let found = { outcome: null, nearest: null };

  function draw() {
    if (scheduled) return;
    scheduled = true;
    requestAnimationFrame(() => {
      scheduled = false;
      // From below, the grid would lie between the eye and the surface.
      ground.grid.visible = view.camera.position.z > ground.height();
      render();
    });
  }

  function render() {
    const { camera } = view;
    camera.updateMatrixWorld();
    camera.localToWorld(key.position.set(-0.6, 0.9, 1));
    key.target.position.copy(camera.position);
    cube.turn(camera);
    drawing.render(scene, camera);
  }

  /** Draws a picture that moves: a long path with fewer segments, until it has come to rest. */
  function move() {
    path.move(true);
    drawing.move(true);
    clearTimeout(resting);
    resting = setTimeout(() => {
      const isOther = path.move(false);
      if (drawing.move(false) || isOther) draw();
    }, REST_MS);
    draw();
  }

  function theme() {
    const style = getComputedStyle(root);
    const color = (/** @type {string} */ name) => new Color(style.getPropertyValue(name).trim() || '#888');
    for (const part of [surface, others, path, cutter, zones, start, ground]) part.theme(color);
    draw();
  }

  /** What lies over the picture. */
  const controls = [...(root.parentElement?.children ?? [])].filter(({ id }) => !ASIDE.includes(id));

  /** What controls cover of it. */
  function covered() {
    const { left, top } = root.getBoundingClientRect();
    return [...controls.map((control) => control.getBoundingClientRect()), cube.box()]
      .filter(({ width, height }) => width > 0 && height > 0)
      .map((box) => ({
        left: box.left - left,
        top: box.top - top,
        right: box.right - left,
        bottom: box.bottom - top,
      }));
  }

  function resize() {
    const { clientWidth: width, clientHeight: height } = root;
    if (!drawing.resize(width, height)) return;
    view.resize(width, height);
    // Drawn at once: a canvas that changed its size is empty until then.
    render();
  }

  resize();
  new ResizeObserver(resize).observe(root);
  const settling = new ResizeObserver(() => view.settle());
  for (const control of controls) settling.observe(control);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', theme);
  canvas.addEventListener('webglcontextrestored', draw);
  theme();

  let pressed = { x: 0, y: 0 };
  canvas.addEventListener('pointerdown', ({ clientX, clientY }) => {
    pressed = { x: clientX, y: clientY };
  });
  canvas.addEventListener('pointerup', ({ clientX, clientY }) => {
    if (Math.hypot(clientX - pressed.x, clientY - pressed.y) > CLICK) return;
    const { left, top, width, height } = canvas.getBoundingClientRect();
    const ray = new Raycaster();
    const at = new Vector2(((clientX - left) / width) * 2 - 1, 1 - ((clientY - top) / height) * 2);
    ray.setFromCamera(at, view.camera);
    const isPicking = Boolean(last?.picking);
    const face = isPicking ? null : others.pick(ray, surface.mesh);
    if (face !== null) {
      onFace(face);
      return;
    }
    const [hit] = surface.mesh.visible ? ray.intersectObject(surface.mesh) : [];
    const outcome = last?.outcome;
    if (isPicking) {
      if (hit) onPoint(hit.point.toArray());
      return;
    }
    if (!hit) return;
    const vertex = hit.face?.a ?? 0;
    const excess = outcome?.picture && outcome.excess ? outcome.excess[vertex] : Number.NaN;
    onPick(hit.point.toArray(), Number.isNaN(excess) ? null : excess);
    if (outcome && hasPostures(outcome)) goTo(outcome, hit.point);
  });

  /** Moves the cutter to the place on the path that is nearest. @param {Outcome} outcome @param {import('three').Vector3} place */
  function goTo(outcome, { x, y, z }) {
    if (found.outcome !== outcome) found = { outcome, nearest: createNearest(outcome) };
    const place = found.nearest?.(x, y, z) ?? -1;
    if (place >= 0) onAt(shareAt(outcome.path, place));
  }

  /** @param {State} state */
  function showSurface(state) {
    const { outcome, layers } = state;
    const picture = outcome?.picture ?? state.picture;
    others.set(state.faces, state.draft?.spec.source.face ?? 0);
    const isNew = surface.set(picture);
    if (isNew && picture) {
      ground.set(surface.box);
      view.frame(surface.box, looksDown(picture));
      // Another surface is looked at afresh; a new plan of the same one leaves the eye where it is.
      const place = [surface.box.min, surface.box.max]
        .map((p) => p.toArray().map((x) => x.toPrecision(3)))
        .join();
      if (place !== framed) view.look('iso');
      framed = place;
    }
    const isRun = state.at < 1 && layers.tint === 'excess' && state.removal?.outcome === outcome;
    const removal = isRun ? state.removal : null;
    const isOther = isNew || (running?.removal ?? null) !== removal;
    if (
      isOther ||
      painted.outcome !== outcome ||
      painted.layers !== layers ||
      painted.range !== state.range
    ) {
      const tint = tintOf(state);
      running = removal && tint ? { removal, removing: createRemoving(removal, tint.values.length) } : null;
      surface.paint(running && tint ? { ...tint, values: running.removing.left } : tint);
      // Before anything is planned, which side is cut is the question.
      surface.showArrows(layers.side || !outcome);
      path.show(layers, tint !== null);
      zones.root.cubes.visible = layers.zones;
    }
    if (running && outcome) surface.repaint(running.removing.to(locate(outcome.path, state.at).point));
    if (isNew || state.runs !== painted.runs) overlays.set(runsOf(state).filter(({ isLaid }) => isLaid));
  }

  /** @param {State} state */
  function showPath({ outcome, layers, at }) {
    const size = surface.box.isEmpty() ? 100 : surface.box.min.distanceTo(surface.box.max);
    path.set(outcome, size);
    zones.set(outcome?.zones ?? null, outcome?.zoneEdge ?? 1, (before, after) => {
      after.visible = layers.zones;
      scene.remove(before);
      scene.add(after);
    });
    cutter.set(outcome?.outline ?? null);
    if (!outcome || outcome.path.length === 0) {
      cutter.show(false);
      return;
    }
    // With the whole path shown, the cutter stands where it last cut rather than far above.
    const place = at >= 1 ? lastCut(outcome.path) : at;
    const { point, tip, axis } = locate(outcome.path, place);
    path.upTo(at >= 1 ? Infinity : point);
    cutter.place(tip, axis);
    // A preview tells where the cutter touches, not how it stands.
    cutter.show(layers.cutter && !outcome.isPreview);
  }

  return {
    /** @param {State} state */
    update(state) {
      // Where points are picked, and which, is drawn too.
      const keys = /** @type {const} */ ([
        'picture',
        'faces',
        'outcome',
        'planned',
        'layers',
        'at',
        'picking',
        'draft',
        'runs',
        'removal',
        'range',
      ]);
      if (last && keys.every((name) => last?.[name] === state[name])) return;
      last = state;
      start.set(state.draft?.spec);
      showSurface(state);
      showPath(state);
      const isPlaying = painted.outcome === state.outcome && painted.at !== state.at;
      painted = {
        outcome: state.outcome,
        layers: state.layers,
        at: state.at,
        range: state.range,
        runs: state.runs,
      };
      if (isPlaying) move();
      else draw();
    },

    /** @param {string} name 'fit', 'iso', or a side. */
    look: (name) => view.look(name),

    /** With perspective or without. @param {boolean} isParallel */
    project: (isParallel) => view.project(isParallel),

    /** The picture as it stands, what is fitted in its middle, on a canvas that keeps it. */
    copy() {
      path.move(false);
      drawing.move(false);
      const copy = document.createElement('canvas');
      Object.assign(copy, { width: canvas.width, height: canvas.height });
      view.centred(() => {
        render();
        const context = copy.getContext('2d');
        if (!context) return;
        context.fillStyle = getComputedStyle(root).getPropertyValue('--stage-high');
        context.fillRect(0, 0, copy.width, copy.height);
        context.drawImage(canvas, 0, 0);
      });
      render();
      return copy;
    },
  };
}

/** Whether the side that is cut looks down on the whole. @param {import('../types.js').Picture} picture */
function looksDown({ normals }) {
  let sum = 0;
  for (let i = 2; i < normals.length; i += 3) sum += normals[i];
  return sum < -0.1 * (normals.length / 3);
}
