/** What draws: on a graphics card as finely as that can, without one as fast as a processor can. */
import { SRGBColorSpace, WebGLRenderer } from 'three';

/** Sharper than this nobody sees, and it costs the square. */
const SHARPEST = 2;

/** Where a processor draws: pixels for each of the screen's while the picture moves. */
const MOVING = 0.6;

/** Names of what draws without a graphics card: in Chromium, in Firefox on Linux, on Windows. */
const PROCESSOR = /swiftshader|llvmpipe|softpipe|software|basic render/i;

/** Whether a processor draws, which only a context can tell. */
function isProcessor() {
  const context = document.createElement('canvas').getContext('webgl2');
  if (!context) return false;
  const named = context.getExtension('WEBGL_debug_renderer_info');
  const name = context.getParameter(named ? named.UNMASKED_RENDERER_WEBGL : context.RENDERER);
  context.getExtension('WEBGL_lose_context')?.loseContext();
  return PROCESSOR.test(String(name));
}

/** @param {HTMLCanvasElement} canvas */
export function createRenderer(canvas) {
  const isSlow = isProcessor();
  // A processor takes as long for smooth edges as for all else. `desynchronized` hands a frame on without the page waiting for it.
  const how = { alpha: true, antialias: !isSlow, desynchronized: isSlow };
  const context = /** @type {WebGL2RenderingContext | null} */ (canvas.getContext('webgl2', how));
  const renderer = new WebGLRenderer({ canvas, context: context ?? undefined, ...how });
  renderer.outputColorSpace = SRGBColorSpace;
  // Asking whether a shader compiled waits until it has.
  renderer.debug.checkShaderErrors = false;
  const size = { width: 0, height: 0, ratio: 0 };
  let isMoving = false;

  return {
    /** CSS pixels; whether anything changed. @param {number} width @param {number} height */
    resize(width, height) {
      const ratio = Math.min(devicePixelRatio, isSlow ? 1 : SHARPEST);
      const isSame = size.width === width && size.height === height && size.ratio === ratio;
      if (width === 0 || height === 0 || isSame) return false;
      Object.assign(size, { width, height, ratio });
      renderer.setSize(width, height, false);
      return true;
    },

    /** Draws more coarsely while the picture moves, if that is slow; whether this makes a difference. @param {boolean} moves */
    move(moves) {
      const isOther = isSlow && moves !== isMoving;
      isMoving = moves;
      return isOther;
    },

    /** @param {import('three').Scene} scene @param {import('three').Camera} camera */
    render(scene, camera) {
      const ratio = size.ratio * (isSlow && isMoving ? MOVING : 1);
      // Right before it is filled anew: a canvas that changed its size is empty.
      if (ratio > 0 && ratio !== renderer.getPixelRatio()) renderer.setPixelRatio(ratio);
      renderer.render(scene, camera);
    },
  };
}
