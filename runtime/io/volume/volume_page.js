// SPDX-License-Identifier: Apache-2.0
// Shows the volumetric image that the page holds: turned, zoomed and sliced with the mouse.
//
// Voxels are painted from the back to the front as squares on a plain canvas, sorted by depth with
// a counting sort: no graphics driver is asked for, and transparent voxels come out right.
'use strict';

const frame = JSON.parse(document.getElementById('frame').textContent);
const canvas = document.getElementById('view');
const context = canvas.getContext('2d', {alpha: false});
const kBackground = [21, 23, 27];
const kBuckets = 65536;

/// What is seen: angles in radians, `cut` is the share of the depth that is taken away in front.
const start = {
    around: frame.around,
    above: frame.above,
    zoom: 1,
    cut: 0
};
const view = {
    ...start,
    low: [0, 0, 0],
    high: [...frame.size]
};
const voxels = {};

async function unpack(id) {
    const text = atob(document.getElementById(id).textContent);
    const bytes = new Uint8Array(text.length);
    for (let n = 0; n < text.length; ++n) bytes[n] = text.charCodeAt(n);
    const plain = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
    return new Response(plain).arrayBuffer();
}

/// The point at voxel coordinates (x, y, z), in the observer's coordinates, metres: the table at
/// the head of scenes/VOLUMES.md.
function point(x, y, z) {
    if (frame.layout === 'lattice')
        return [x, y, z].map((c, axis) => frame.origin[axis] + frame.edge[axis] * c);
    const depth = frame.near + frame.step * z;
    const u = 2 * x / frame.size[0] - 1, v = 2 * y / frame.size[1] - 1;
    const [a, b] = frame.half;
    if (frame.shape === 'box') return [-u * a, -v * b, depth];
    if (frame.shape === 'pyramid') return [-u * a * depth, -v * b * depth, depth];
    if (frame.shape === 'ball')
        return [
            -Math.sin(u * a) * Math.cos(v * b) * depth, -Math.sin(v * b) * depth,
            Math.cos(u * a) * Math.cos(v * b) * depth
        ];
    const r = Math.hypot(u, v), share = r > 0 ? Math.sin(r * a) / r : 0;
    return [-u * share * depth, -v * share * depth, Math.cos(r * a) * depth];
}

function distance(p, q) { return Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]); }

/// Fills `voxels`: cells, colours, middles and edges, and the sphere around all.
async function readVoxels() {
    const n = frame.count, data = await unpack('voxels');
    voxels.cells = [0, 1, 2].map(axis => new Uint16Array(data, 2 * n * axis, n));
    voxels.colors = new Uint8Array(data, 6 * n, 4 * n);
    voxels.points = [0, 1, 2].map(() => new Float32Array(n));
    voxels.edges = new Float32Array(n);
    voxels.screen = [new Float32Array(n), new Float32Array(n), new Float32Array(n)];
    voxels.order = new Uint32Array(n);
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    const m = frame.merged;
    for (let i = 0; i < n; ++i) {
        const [x, y, z] = voxels.cells.map(cells => cells[i] * m + m / 2);
        const p = point(x, y, z);
        voxels.edges[i] = Math.max(
            distance(p, point(x + m, y, z)), distance(p, point(x, y + m, z)),
            distance(p, point(x, y, z + m)));
        for (let axis = 0; axis < 3; ++axis) {
            voxels.points[axis][i] = p[axis];
            low[axis] = Math.min(low[axis], p[axis]);
            high[axis] = Math.max(high[axis], p[axis]);
        }
    }
    voxels.middle = n > 0 ? low.map((l, axis) => (l + high[axis]) / 2) : [0, 0, 0];
    voxels.radius = n > 0 ? Math.max(distance(low, high) / 2, voxels.edges[0]) : 1;
}

/// Puts every voxel on the screen; returns how many are shown, their numbers by depth in `order`.
function project(width, height, scale) {
    const sa = Math.sin(view.around), ca = Math.cos(view.around);
    const sb = Math.sin(view.above), cb = Math.cos(view.above);
    const right = [-ca, 0, sa], ahead = [sa * cb, -sb, ca * cb];
    const up = [
        right[1] * ahead[2] - right[2] * ahead[1], right[2] * ahead[0] - right[0] * ahead[2],
        right[0] * ahead[1] - right[1] * ahead[0]
    ];
    const [px, py, pz] = voxels.points, [mx, my, mz] = voxels.middle, [sx, sy, sz] = voxels.screen;
    const [ci, cj, ck] = voxels.cells, m = frame.merged;
    const low = view.low.map(l => l / m), high = view.high.map(h => h / m);
    const away = 3 * voxels.radius, nearest = away - voxels.radius;
    const first = nearest + 2 * voxels.radius * view.cut;
    const toBucket = (kBuckets - 1) / (2.001 * voxels.radius);
    const counts = new Uint32Array(kBuckets + 1);
    let shown = 0;
    for (let i = 0; i < frame.count; ++i) {
        const x = px[i] - mx, y = py[i] - my, z = pz[i] - mz;
        const depth = away + x * ahead[0] + y * ahead[1] + z * ahead[2];
        sz[i] = 0;
        if (depth < first || ci[i] + 1 <= low[0] || ci[i] >= high[0] || cj[i] + 1 <= low[1] ||
            cj[i] >= high[1] || ck[i] + 1 <= low[2] || ck[i] >= high[2])
            continue;
        const by = scale / depth;
        sx[i] = width / 2 + (x * right[0] + y * right[1] + z * right[2]) * by;
        sy[i] = height / 2 - (x * up[0] + y * up[1] + z * up[2]) * by;
        sz[i] = depth;
        ++counts[bucket(depth, nearest, toBucket) + 1];
        ++shown;
    }
    for (let b = 0; b < kBuckets; ++b) counts[b + 1] += counts[b];
    for (let i = 0; i < frame.count; ++i)
        if (sz[i] > 0) voxels.order[counts[bucket(sz[i], nearest, toBucket)]++] = i;
    return shown;
}

function bucket(depth, nearest, toBucket) {
    return Math.max(0, Math.min(kBuckets - 1, (depth - nearest) * toBucket)) | 0;
}

/// Paints the voxels of `order`, the last and farthest first.
function paint(pixels, width, height, scale, shown) {
    const [sx, sy, sz] = voxels.screen, colors = voxels.colors, edges = voxels.edges;
    for (let n = shown - 1; n >= 0; --n) {
        const i = voxels.order[n];
        // A cube's outline is wider than its edge, seen from most sides.
        const side = Math.ceil(1.3 * edges[i] * scale / sz[i]);
        const left = Math.round(sx[i] - side / 2), top = Math.round(sy[i] - side / 2);
        const r = colors[4 * i], g = colors[4 * i + 1], b = colors[4 * i + 2];
        const opacity = colors[4 * i + 3] / 255;
        const y1 = Math.min(top + side, height), x1 = Math.min(left + side, width);
        for (let y = Math.max(top, 0); y < y1; ++y)
            for (let x = Math.max(left, 0); x < x1; ++x) {
                const at = 4 * (y * width + x);
                pixels[at] += (r - pixels[at]) * opacity;
                pixels[at + 1] += (g - pixels[at + 1]) * opacity;
                pixels[at + 2] += (b - pixels[at + 2]) * opacity;
            }
    }
}

function draw() {
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== width || canvas.height !== height)
        [canvas.width, canvas.height] = [width, height];
    const picture = context.createImageData(width, height), pixels = picture.data;
    const dark = 0xff000000 | kBackground[2] << 16 | kBackground[1] << 8 | kBackground[0];
    new Uint32Array(pixels.buffer).fill(dark);
    const scale = view.zoom * 1.35 * Math.min(width, height);
    paint(pixels, width, height, scale, project(width, height, scale));
    context.putImageData(picture, 0, 0);
    document.body.dataset.drawn = Number(document.body.dataset.drawn || 0) + 1;
}

let waiting = false;
function redraw() {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
        waiting = false;
        draw();
    });
}

function between(low, value, high) { return Math.max(low, Math.min(high, value)); }

function turn(dx, dy) {
    view.around -= dx;
    view.above = between(-Math.PI / 2, view.above + dy, Math.PI / 2);
    redraw();
}

/// Two sliders for each axis: the voxels from one to the other are shown.
function addCuts() {
    const names = frame.layout === 'lattice' ? ['x', 'y', 'z'] : ['u', 'v', 'k'];
    names.forEach((name, axis) => {
        const label = document.createElement('label');
        label.append(name);
        for (const end of ['low', 'high']) {
            const slider = document.createElement('input');
            Object.assign(slider, {type: 'range', min: 0, max: frame.size[axis], step: 1});
            slider.value = view[end][axis];
            slider.title = `${name} ${end === 'low' ? 'from' : 'to'}`;
            slider.addEventListener('input', () => {
                view[end][axis] = Number(slider.value);
                redraw();
            });
            label.append(slider);
        }
        document.getElementById('cuts').append(label);
    });
}

function listen() {
    canvas.addEventListener('pointerdown', event => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener('pointermove', event => {
        if (event.buttons === 0) return;
        const size = Math.min(canvas.clientWidth, canvas.clientHeight);
        const dx = event.movementX / size, dy = event.movementY / size;
        if (event.buttons === 1 && !event.shiftKey) return turn(dx * Math.PI, dy * Math.PI);
        view.cut = between(0, view.cut - dy, 1);
        redraw();
    });
    canvas.addEventListener('contextmenu', event => event.preventDefault());
    canvas.addEventListener('wheel', event => {
        event.preventDefault();
        view.zoom = between(0.2, view.zoom * Math.exp(-event.deltaY / 600), 50);
        redraw();
    }, {passive: false});
    canvas.addEventListener('dblclick', () => {
        Object.assign(view, start, {low: [0, 0, 0], high: [...frame.size]});
        document.getElementById('cuts').replaceChildren();
        addCuts();
        redraw();
    });
    const keys =
        {ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1]};
    canvas.addEventListener('keydown', event => keys[event.key] && turn(...keys[event.key]));
    window.addEventListener('resize', redraw);
}

async function main() {
    if (typeof DecompressionStream === 'undefined')
        throw new Error('this browser is too old to unpack the voxels: use one from 2023 or later');
    await readVoxels();
    addCuts();
    listen();
    draw();
    document.body.dataset.ready = 'yes';
}

main().catch(error => {
    document.getElementById('about').textContent = error.message;
});
