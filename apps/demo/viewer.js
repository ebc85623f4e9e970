'use strict';
// Figures whose model turns when it is dragged. Each keeps its still picture until it is scrolled into view; then three.js
// is started, once for all of them, and draws what its camera sees onto a canvas in the picture's place. Nothing is drawn
// while nothing moves. Where there is no WebGL the pictures stay.
(() => {
  const crease = Math.cos(40 * Math.PI / 180);
  let renderer;

  function start() {
    if (renderer) return;
    for (const source of document.querySelectorAll('script.three')) {
      const script = document.createElement('script');
      script.textContent = source.textContent;
      document.head.append(script);
    }
    renderer = new THREE.WebGLRenderer({alpha: true, antialias: true});
    renderer.gammaOutput = true;
    renderer.gammaFactor = 2.2;
  }

  // Of each corner, the faces at its vertex. Corners of one vertex have the same coordinates to the bit.
  function facesAround(position) {
    const at = new Map();
    const lists = Array.from({length: position.length / 3}, (_, i) => {
      const place = position.subarray(3 * i, 3 * i + 3).join();
      if (!at.has(place)) at.set(place, []);
      at.get(place).push(Math.floor(i / 3));
      return place;
    });
    return lists.map(place => at.get(place));
  }

  // A corner's normal is the mean of those of the faces at its vertex that are less than a crease away from its own.
  function setNormals(geometry) {
    const position = geometry.attributes.position.array, normals = new Float32Array(position.length), sum = new THREE.Vector3();
    geometry.userData.around = geometry.userData.around || facesAround(position);
    const corner = i => new THREE.Vector3().fromArray(position, 3 * i);
    const areas = Array.from({length: position.length / 9}, (_, face) => {
      const origin = corner(3 * face);
      return corner(3 * face + 1).sub(origin).cross(corner(3 * face + 2).sub(origin));
    });
    const units = areas.map(area => area.clone().normalize());
    geometry.userData.around.forEach((faces, i) => {
      const own = units[Math.floor(i / 3)];
      sum.set(0, 0, 0);
      for (const face of faces) {
        if (own.dot(units[face]) >= crease) sum.add(areas[face]);
      }
      sum.normalize().toArray(normals, 3 * i);
    });
    geometry.setAttribute('normal', new THREE.BufferAttribute(normals, 3));
  }

  function prepare(node) {
    node.name = node.name.replace(/_/g, ' ');  // the loader's
    node.geometry = node.geometry.toNonIndexed();
    setNormals(node.geometry);
    node.material.flatShading = false;
    node.material.side = THREE.DoubleSide;
    node.material.roughness = 0.75;
    node.material.wireframe = node.name.startsWith('cage');
    return node;
  }

  // What the slider and the switch do: a function of both for each kind.
  const kinds = {
    apart(nodes) {
      const all = new THREE.Box3(), boxes = nodes.map(node => new THREE.Box3().setFromObject(node));
      boxes.forEach(box => all.union(box));
      const centre = all.getCenter(new THREE.Vector3());
      const ways = boxes.map(box => box.getCenter(new THREE.Vector3()).sub(centre));
      return (value, hulls) => nodes.forEach((node, i) => {
        node.visible = node.name.startsWith(hulls ? 'hull' : 'part');
        node.position.copy(ways[i]).multiplyScalar(value);
      });
    },
    between(nodes) {
      const pairs = nodes.filter(node => node.name.endsWith(' from')).map(from => {
        const to = nodes.find(node => node.name === from.name.replace(/from$/, 'to'));
        to.visible = false;
        return [from.geometry, from.geometry.attributes.position.array.slice(), to.geometry.attributes.position.array];
      });
      return value => pairs.forEach(([geometry, from, to]) => {
        const position = geometry.attributes.position;
        for (let i = 0; i < from.length; ++i) position.array[i] = from[i] + value * (to[i] - from[i]);
        position.needsUpdate = true;
        setNormals(geometry);
      });
    },
    along(nodes) {
      const robots = nodes.filter(node => node.name.startsWith('robot'));
      const number = node => Number(node.name.split(' ')[1]);
      const last = Math.max(...robots.map(number));
      return value => robots.forEach(node => {
        node.visible = value === 0 || number(node) === Math.round(value * last);
      });
    },
  };

  class View {
    constructor(figure, model) {
      const view = figure.querySelector('.view'), picture = view.querySelector('img'), controls = figure.querySelector('.controls');
      const numbers = figure.dataset.camera.split(' ').map(Number);
      const eye = new THREE.Vector3().fromArray(numbers);
      this.about = new THREE.Vector3().fromArray(numbers, 3);
      this.place = new THREE.Spherical().setFromVector3(eye.sub(this.about));
      this.camera = new THREE.PerspectiveCamera(24, picture.width / picture.height, this.place.radius / 50, 10 * this.place.radius);
      this.scene = new THREE.Scene();
      const nodes = [];
      model.scene.traverse(node => { if (node.isMesh) nodes.push(prepare(node)); });
      const lamp = new THREE.DirectionalLight(0xffffff, 0.6);
      lamp.position.set(-1, 1.6, 1.2);
      this.camera.add(lamp);
      this.scene.add(model.scene, this.camera, new THREE.HemisphereLight(0xf4f6ff, 0x8a8378, 0.55));

      this.canvas = document.createElement('canvas');
      this.canvas.tabIndex = 0;
      this.canvas.setAttribute('role', 'img');
      this.canvas.setAttribute('aria-label', picture.alt);
      this.listen(this.canvas);
      const [slider, box] = controls.querySelectorAll('input');
      const set = kinds[figure.dataset.slider](nodes);
      const update = () => { set(Number(slider.value), box && box.checked); this.draw(); };
      slider.addEventListener('input', update);
      if (box) box.addEventListener('change', update);
      view.append(this.canvas);
      controls.hidden = false;
      update();
      picture.classList.add('covered');
      new ResizeObserver(() => this.draw()).observe(this.canvas);
    }

    // Fingers turn sideways only, so that the page can still be scrolled.
    listen(canvas) {
      let last;
      canvas.addEventListener('pointerdown', event => {
        last = event;
        canvas.setPointerCapture(event.pointerId);
      });
      canvas.addEventListener('pointermove', event => {
        if (!last || event.pointerId !== last.pointerId) return;
        this.turn(event.clientX - last.clientX, event.pointerType === 'mouse' ? event.clientY - last.clientY : 0);
        last = event;
      });
      for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, () => { last = undefined; });
      canvas.addEventListener('keydown', event => {
        const step = {ArrowLeft: [-20, 0], ArrowRight: [20, 0], ArrowUp: [0, -20], ArrowDown: [0, 20]}[event.key];
        if (!step) return;
        event.preventDefault();
        this.turn(...step);
      });
    }

    turn(right, down) {
      this.place.theta -= 0.008 * right;
      this.place.phi = Math.min(3.1, Math.max(0.04, this.place.phi - 0.008 * down));
      this.draw();
    }

    draw() {
      const ratio = Math.min(2, devicePixelRatio), {clientWidth, clientHeight} = this.canvas;
      if (!clientWidth) return;
      this.canvas.width = Math.round(ratio * clientWidth);
      this.canvas.height = Math.round(ratio * clientHeight);
      this.camera.position.setFromSpherical(this.place).add(this.about);
      this.camera.lookAt(this.about);
      renderer.setSize(this.canvas.width, this.canvas.height, false);
      renderer.render(this.scene, this.camera);
      this.canvas.getContext('2d').drawImage(renderer.domElement, 0, 0);
    }
  }

  function show(figure) {
    start();
    const bytes = Uint8Array.from(atob(figure.querySelector('script').textContent), letter => letter.charCodeAt(0));
    new THREE.GLTFLoader().parse(bytes.buffer, '', model => new View(figure, model), () => {});
  }

  const drawable = document.createElement('canvas').getContext('webgl');
  if (!drawable || !window.IntersectionObserver || !window.ResizeObserver) return;
  const near = new IntersectionObserver(entries => {
    for (const entry of entries) {
      if (!entry.isIntersecting) continue;
      near.unobserve(entry.target);
      show(entry.target);
    }
  }, {rootMargin: '200px'});
  document.querySelectorAll('figure.turn').forEach(figure => near.observe(figure));
})();
