// The library that draws, three.js: its version is a part of its address, and is named here only.

export * from "/view/three-0.180.0/three.module.min.js";
export { OrbitControls } from "/view/three-0.180.0/OrbitControls.js";
