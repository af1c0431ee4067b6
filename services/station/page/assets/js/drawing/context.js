// What pictures are drawn with, and whether a graphics card does it or the processor, which has other things to do.

const SOFTWARE = /swiftshader|llvmpipe|software|basic render/i;

// Null where this browser cannot draw in three dimensions.
export function contextOf(canvas) {
  const probe = document.createElement("canvas").getContext("webgl2");
  if (!probe) return null;
  const isSlow = isSoftware(probe);
  probe.getExtension("WEBGL_lose_context")?.loseContext();
  const context = canvas.getContext("webgl2", { alpha: false, antialias: !isSlow, powerPreference: "low-power" });
  return context && { context, isSlow };
}

function isSoftware(context) {
  const details = context.getExtension("WEBGL_debug_renderer_info");
  return SOFTWARE.test(context.getParameter(details ? details.UNMASKED_RENDERER_WEBGL : context.RENDERER));
}
