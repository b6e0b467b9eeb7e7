/* What the pages use of three.js. */
export {
  BackSide, BufferAttribute, BufferGeometry, Color, ColorManagement, EqualStencilFunc, HemisphereLight, InstancedMesh, LinearSRGBColorSpace,
  Matrix4, Mesh, MeshBasicMaterial, MeshLambertMaterial, NotEqualStencilFunc, OrthographicCamera, Plane, PlaneGeometry, ReplaceStencilOp, Scene,
  Vector3, WebGLRenderer,
} from "three";
export { OrbitControls } from "three/addons/controls/OrbitControls.js";
