// src/api/events.ts
async function* readEvents(body) {
	const reader = body.getReader();
	const decoder = new TextDecoder();
	let text = "";
	try {
		while (true) {
			const { done, value } = await reader.read();
			if (done) return;
			text += decoder.decode(value, { stream: true }).replaceAll("\r", "");
			const blocks = text.split("\n\n");
			text = blocks.pop();
			for (const block of blocks) {
				const event = parseEvent(block);
				if (event) yield event;
			}
		}
	} finally {
		await reader.cancel().catch(() => {});
	}
}
function parseEvent(block) {
	let event = "message";
	const data = [];
	for (const line of block.split("\n")) {
		const [, field, value] = /^([^:]+): ?(.*)$/.exec(line) ?? [];
		if (field === "event") event = value;
		if (field === "data") data.push(value);
	}
	return data.length > 0 ? {
		event,
		data: data.join("\n")
	} : null;
}
// src/api/client.ts
/** Calls of the server's HTTP API. */
/** What the server refused, in its words. */
var ApiError = class extends Error {
	status;
	kind;
	nearestFree;
	constructor(status, body) {
		super(body.message);
		this.status = status;
		this.kind = body.error;
		this.nearestFree = body.details?.nearest_free;
	}
};
var Client = class {
	base;
	constructor(base) {
		this.base = base;
	}
	options() {
		return this.json("options");
	}
	maps() {
		return this.json("maps");
	}
	map(id) {
		return this.json(`maps/${encodeURIComponent(id)}`);
	}
	generate(request) {
		return this.json("maps/generate", post(request));
	}
	edit(id, strokes) {
		return this.json(`maps/${id}/edit`, post({ strokes }));
	}
	upload(files, resolution) {
		const body = new FormData();
		for (const file of files) body.append("files", file);
		if (resolution !== null) body.append("resolution", String(resolution));
		return this.json("maps", {
			method: "POST",
			body
		});
	}
	async image(id) {
		return (await this.send(`maps/${id}/image`)).blob();
	}
	imageUrl(id) {
		return this.url(`maps/${id}/image`);
	}
	plan(request, signal) {
		return this.json("plan", {
			...post(request),
			signal
		});
	}
	async *planStream(request, signal) {
		const response = await this.send("plan/stream", {
			...post(request),
			signal
		});
		for await (const { event, data } of readEvents(response.body)) {
			const value = JSON.parse(data);
			if (event === "error") throw new ApiError(response.status, value);
			yield {
				event,
				data: value
			};
		}
	}
	url(path) {
		return new URL(path, this.base).href;
	}
	async json(path, init) {
		return (await this.send(path, init)).json();
	}
	async send(path, init) {
		const response = await fetch(this.url(path), init).catch((error) => {
			if (init?.signal?.aborted) throw error;
			throw new ApiError(0, {
				error: "Unreachable",
				message: "The server does not answer. Is `planformer serve` still running?"
			});
		});
		if (!response.ok) throw new ApiError(response.status, await errorBody(response));
		return response;
	}
};
function post(value) {
	return {
		method: "POST",
		headers: { "content-type": "application/json" },
		body: JSON.stringify(value)
	};
}
async function errorBody(response) {
	try {
		const body = await response.json();
		if (typeof body.message === "string") return body;
	} catch {}
	return {
		error: "HttpError",
		message: `The server answered ${response.status} ${response.statusText}.`
	};
}
// src/geometry/frame.ts
function toWorld$1(map, local) {
	const [x, y, yaw] = map.origin;
	const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
	return {
		x: x + c * local.x - s * local.y,
		y: y + s * local.x + c * local.y
	};
}
function toLocal(map, world) {
	const [x, y, yaw] = map.origin;
	const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
	const [dx, dy] = [world.x - x, world.y - y];
	return {
		x: c * dx + s * dy,
		y: -s * dx + c * dy
	};
}
/** The nearest point on the map, a little inside its edge. */
function clampToMap(map, world) {
	const { x, y } = toLocal(map, world);
	const clamp = (value, size) => Math.min(Math.max(value, .001), Math.max(size - .001, .001));
	return toWorld$1(map, {
		x: clamp(x, map.width),
		y: clamp(y, map.height)
	});
}
/** The smallest upright rectangle round the map in the world frame. */
function mapBounds(map) {
	const corners = [
		[0, 0],
		[map.width, 0],
		[0, map.height],
		[map.width, map.height]
	].map(([x, y]) => toWorld$1(map, {
		x,
		y
	}));
	const xs = corners.map((corner) => corner.x);
	const ys = corners.map((corner) => corner.y);
	return {
		left: Math.min(...xs),
		right: Math.max(...xs),
		bottom: Math.min(...ys),
		top: Math.max(...ys)
	};
}
// src/model/raster.ts
async function decodeRaster(image) {
	const rgba = await imagePixels(image);
	const cells = new Uint8Array(rgba.width * rgba.height);
	for (let i = 0; i < cells.length; i++) cells[i] = rgba.data[4 * i];
	return {
		columns: rgba.width,
		rows: rgba.height,
		cells
	};
}
async function imagePixels(image) {
	const bitmap = await createImageBitmap(image, { colorSpaceConversion: "none" });
	const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
	const context = canvas.getContext("2d", { willReadFrequently: true });
	context.drawImage(bitmap, 0, 0);
	bitmap.close();
	return context.getImageData(0, 0, canvas.width, canvas.height);
}
// src/model/ends.ts
/** Half as far again from obstacles as the robot needs: a comfortable place. */
var COMFORT = 1.5;
function farApart(raster, map, radius) {
	const cells = Math.max(1, Math.ceil(COMFORT * radius / map.resolution));
	const open = Uint8Array.from(clearance(raster), (steps) => steps > cells ? 1 : 0);
	const start = nearest(raster, open, 0, raster.rows - 1);
	if (start === null) return null;
	const goal = nearest(raster, connected(raster, open, start), raster.columns - 1, 0);
	return [centre(raster, map, start), centre(raster, map, goal)];
}
function centre({ columns, rows }, map, cell) {
	const column = cell % columns;
	const row = rows - 1 - Math.floor(cell / columns);
	return toWorld$1(map, {
		x: (column + .5) * map.resolution,
		y: (row + .5) * map.resolution
	});
}
/** Steps (8 neighbours) from each cell to the nearest one that is not free; outside is not. */
function clearance({ columns, rows, cells }) {
	const steps = new Int32Array(cells.length);
	const at = (row, column) => row < 0 || row >= rows || column < 0 || column >= columns ? 0 : steps[row * columns + column];
	const pass = (row, column, back) => {
		const index = row * columns + column;
		const near = Math.min(at(row - back, column - 1), at(row - back, column), at(row - back, column + 1), at(row, column - back));
		steps[index] = Math.min(steps[index], near + 1);
	};
	for (let i = 0; i < cells.length; i++) steps[i] = cells[i] === 255 ? columns + rows : 0;
	for (let row = 0; row < rows; row++) for (let column = 0; column < columns; column++) pass(row, column, 1);
	for (let row = rows - 1; row >= 0; row--) for (let column = columns - 1; column >= 0; column--) pass(row, column, -1);
	return steps;
}
function nearest({ columns }, wanted, column, row) {
	let [best, least] = [null, Number.POSITIVE_INFINITY];
	for (let i = 0; i < wanted.length; i++) {
		if (wanted[i] === 0) continue;
		const away = Math.hypot(i % columns - column, Math.floor(i / columns) - row);
		if (away < least) [best, least] = [i, away];
	}
	return best;
}
/** The open cells that can be reached from a cell, 4-connected. */
function connected({ columns, rows }, open, from) {
	const reached = new Uint8Array(open.length);
	const queue = new Int32Array(open.length);
	let [head, tail] = [0, 0];
	const visit = (cell) => {
		if (open[cell] === 1 && reached[cell] === 0) {
			reached[cell] = 1;
			queue[tail++] = cell;
		}
	};
	visit(from);
	while (head < tail) {
		const cell = queue[head++];
		const column = cell % columns;
		if (column > 0) visit(cell - 1);
		if (column < columns - 1) visit(cell + 1);
		if (cell >= columns) visit(cell - columns);
		if (cell < columns * (rows - 1)) visit(cell + columns);
	}
	return reached;
}
// src/geometry/points.ts
/** The angle in [-pi, pi). */
function wrapAngle(angle) {
	const turn = 2 * Math.PI;
	return angle - turn * Math.floor((angle + Math.PI) / turn);
}
/** A number in as few digits as `digits` decimals need. */
function rounded(value, digits) {
	const scale = 10 ** digits;
	return Math.round(value * scale) / scale + 0;
}
// src/model/problem.ts
function isCar(robot) {
	return robot.kind !== "point";
}
function wireRobot({ kind, radius, turningRadius }) {
	return kind === "point" ? {
		kind,
		radius
	} : {
		kind,
		radius,
		turning_radius: turningRadius
	};
}
function wireState(robot, { x, y, yaw }) {
	return isCar(robot) ? [
		x,
		y,
		yaw
	] : [x, y];
}
/** A pose in whole millimetres and tenths of a milliradian, so that links and snippets are exact. */
function exactPose({ x, y, yaw }) {
	return {
		x: rounded(x, 3),
		y: rounded(y, 3),
		yaw: rounded(yaw, 4)
	};
}
function planRequest(problem, run, limits) {
	const { map, robot, start, goal } = problem;
	return {
		map: map.id,
		robot: wireRobot(robot),
		start: wireState(robot, start),
		goal: wireState(robot, goal),
		planner: run.planner,
		guide: run.guide,
		exploration: run.guide === null ? 0 : run.exploration,
		time_limit: limits.time,
		...limits.seed === null ? {} : { seed: limits.seed },
		tree: true,
		region: run.guide !== null
	};
}
// src/model/share.ts
var KINDS = [
	"forest",
	"maze",
	"indoor"
];
var ROBOTS = [
	"point",
	"dubins",
	"reeds-shepp"
];
var UNGUIDED$1 = "none";
function encode({ source, id, robot, start, goal, runs, limits }) {
	const fields = [];
	if (source.kind === "generated") {
		const { kind, seed, width, height, resolution } = source.request;
		fields.push(["map", `${kind},${seed},${width},${height},${resolution}`]);
		if (source.strokes.length > 0) fields.push(["edits", source.strokes.map(strokeText).join("~")]);
	}
	fields.push(["id", id]);
	fields.push(["robot", `${robot.kind},${robot.radius},${robot.turningRadius}`]);
	fields.push(["start", poseText(start)], ["goal", poseText(goal)]);
	for (const { planner, guide, exploration } of runs) fields.push(["run", `${name(planner)},${name(guide ?? UNGUIDED$1)},${exploration}`]);
	fields.push(["time", String(limits.time)]);
	if (limits.seed !== null) fields.push(["seed", String(limits.seed)]);
	return `#${fields.map(([key, value]) => `${key}=${value}`).join("&")}`;
}
/** Null where the fragment holds no problem, or a damaged one. */
function decode(fragment) {
	const fields = new URLSearchParams(fragment.replace(/^#/, ""));
	try {
		return {
			source: sourceOf$1(fields),
			id: /^[0-9a-f]{16}$/.exec(fields.get("id") ?? "")?.[0] ?? fail("id"),
			robot: robotOf(fields.get("robot") ?? ""),
			start: poseOf(fields.get("start") ?? ""),
			goal: poseOf(fields.get("goal") ?? ""),
			runs: fields.getAll("run").map(runOf),
			limits: {
				time: number(fields.get("time") ?? ""),
				seed: fields.has("seed") ? whole(fields.get("seed")) : null
			}
		};
	} catch (error) {
		if (error instanceof Damaged) return null;
		throw error;
	}
}
/** A stroke whose coordinates survive a link. */
function exactStroke({ points, radius, occupied }) {
	return {
		points: points.map(([x, y]) => [rounded(x, 2), rounded(y, 2)]),
		radius: rounded(radius, 3),
		occupied
	};
}
var Damaged = class extends Error {};
function fail(field) {
	throw new Damaged(field);
}
function name(text) {
	return encodeURIComponent(text).replaceAll(",", "%2C");
}
function number(text) {
	const value = Number(text);
	return text.trim() !== "" && Number.isFinite(value) ? value : fail(text);
}
function whole(text) {
	const value = number(text);
	return Number.isSafeInteger(value) && value >= 0 ? value : fail(text);
}
function poseText({ x, y, yaw }) {
	return `${x},${y},${yaw}`;
}
function poseOf(text) {
	const [x, y, yaw] = text.split(",").map(number);
	if (yaw === void 0) fail("pose");
	return {
		x,
		y,
		yaw
	};
}
function strokeText({ points, radius, occupied }) {
	return [`${occupied ? "w" : "e"}${radius}`, ...points.flat()].join(",");
}
function strokeOf(text) {
	const [brush, ...rest] = text.split(",");
	const values = rest.map(number);
	if (!/^[we]/.test(brush) || values.length < 2 || values.length % 2 !== 0) fail("edits");
	const points = [];
	for (let i = 0; i < values.length; i += 2) points.push([values[i], values[i + 1]]);
	return {
		points,
		radius: number(brush.slice(1)),
		occupied: brush.startsWith("w")
	};
}
function sourceOf$1(fields) {
	const map = fields.get("map");
	if (map === null) return { kind: "stored" };
	const [kind, seed, width, height, resolution] = map.split(",");
	if (resolution === void 0 || !KINDS.includes(kind)) fail("map");
	const edits = fields.get("edits");
	return {
		kind: "generated",
		request: {
			kind,
			seed: whole(seed),
			width: number(width),
			height: number(height),
			resolution: number(resolution)
		},
		strokes: edits === null ? [] : edits.split("~").map(strokeOf)
	};
}
function robotOf(text) {
	const [kind, radius, turningRadius] = text.split(",");
	if (turningRadius === void 0 || !ROBOTS.includes(kind)) fail("robot");
	return {
		kind,
		radius: number(radius),
		turningRadius: number(turningRadius)
	};
}
function runOf(text) {
	const [planner, guide, exploration] = text.split(",");
	if (exploration === void 0) fail("run");
	return {
		planner,
		guide: guide === UNGUIDED$1 ? null : guide,
		exploration: number(exploration)
	};
}
// src/app/maps.ts
/** Gets maps from the server with their cells, and makes shared ones again. */
var Maps = class {
	client;
	constructor(client) {
		this.client = client;
	}
	async generate(request) {
		const info = await this.client.generate(request);
		return this.load(info, {
			kind: "generated",
			request,
			strokes: []
		});
	}
	async upload(files, resolution) {
		return this.load(await this.client.upload(files, resolution), { kind: "stored" });
	}
	async open(info) {
		return this.load(info, sourceOf(info));
	}
	async edit({ info, source }, stroke) {
		const exact = exactStroke(stroke);
		const edited = await this.client.edit(info.id, [exact]);
		return this.load(edited, source.kind === "stored" ? source : {
			...source,
			strokes: [...source.strokes, exact]
		});
	}
	/** The map of a link: the server's, or made again if it was generated. */
	async shared({ id, source }) {
		try {
			return this.load(await this.client.map(id), source);
		} catch (error) {
			if (!(error instanceof ApiError) || error.status !== 404 || source.kind === "stored") throw error;
		}
		const plain = await this.client.generate(source.request);
		if (source.strokes.length === 0) return this.load(plain, source);
		return this.load(await this.client.edit(plain.id, source.strokes), source);
	}
	async load(info, source) {
		return {
			info,
			source,
			raster: await decodeRaster(await this.client.image(info.id))
		};
	}
};
function sourceOf({ source }) {
	return source ? {
		kind: "generated",
		request: source,
		strokes: []
	} : { kind: "stored" };
}
// src/geometry/view.ts
var MAX_ZOOM = 60;
var MIN_ZOOM = .5;
function fit(bounds, size, margin) {
	const width = Math.max(bounds.right - bounds.left, 1e-6);
	const height = Math.max(bounds.top - bounds.bottom, 1e-6);
	const scale = Math.min((size.width - 2 * margin) / width, (size.height - 2 * margin) / height);
	return {
		centre: {
			x: (bounds.left + bounds.right) / 2,
			y: (bounds.bottom + bounds.top) / 2
		},
		scale: Math.max(scale, .001)
	};
}
function toScreen(view, size, world) {
	return {
		x: size.width / 2 + (world.x - view.centre.x) * view.scale,
		y: size.height / 2 - (world.y - view.centre.y) * view.scale
	};
}
function toWorld(view, size, screen) {
	return {
		x: view.centre.x + (screen.x - size.width / 2) / view.scale,
		y: view.centre.y - (screen.y - size.height / 2) / view.scale
	};
}
/** Moves what is shown by (dx, dy) pixels. */
function panned(view, dx, dy) {
	const { centre, scale } = view;
	return {
		centre: {
			x: centre.x - dx / scale,
			y: centre.y + dy / scale
		},
		scale
	};
}
/** Zooms by a factor; what is under the screen point `at` stays there. */
function zoomed(view, size, at, factor, fitted) {
	const scale = Math.min(Math.max(view.scale * factor, fitted.scale * MIN_ZOOM), fitted.scale * MAX_ZOOM);
	const fixed = toWorld(view, size, at);
	return {
		scale,
		centre: {
			x: fixed.x - (at.x - size.width / 2) / scale,
			y: fixed.y + (at.y - size.height / 2) / scale
		}
	};
}
/** For `setTransform`: from the world to the pixels of a canvas with `ratio` pixels a CSS pixel. */
function worldMatrix(view, size, ratio) {
	const scale = view.scale * ratio;
	const origin = toScreen(view, size, {
		x: 0,
		y: 0
	});
	return [
		scale,
		0,
		0,
		-scale,
		origin.x * ratio,
		origin.y * ratio
	];
}
/** From the screen as `from` shows it to the screen as `to` does: x' = scale x + dx. */
function between(from, to, size) {
	const scale = to.scale / from.scale;
	const corner = toScreen(to, size, toWorld(from, size, {
		x: 0,
		y: 0
	}));
	return {
		scale,
		dx: corner.x,
		dy: corner.y
	};
}
// src/model/tree.ts
/** Coordinates that grow in number. */
var Floats = class {
	values = /* @__PURE__ */ new Float32Array(4096);
	length = 0;
	push4(a, b, c, d) {
		if (this.length + 4 > this.values.length) {
			const larger = new Float32Array(2 * this.values.length);
			larger.set(this.values);
			this.values = larger;
		}
		this.set4(this.length, a, b, c, d);
		this.length += 4;
	}
	set4(at, a, b, c, d) {
		this.values[at] = a;
		this.values[at + 1] = b;
		this.values[at + 2] = c;
		this.values[at + 3] = d;
	}
	get view() {
		return this.values.subarray(0, this.length);
	}
};
var TreeLines = class {
	edges = new Floats();
	roadmap = new Floats();
	/** x0, y0, x1, y1 in metres from each vertex's parent to the vertex; a point for a root. */
	get segments() {
		return this.edges.view;
	}
	/** The same for the further edges of a roadmap. */
	get links() {
		return this.roadmap.view;
	}
	get vertices() {
		return this.edges.length / 4;
	}
	/**
	* Adds an increment; one from vertex 0 replaces what is there.
	*
	* @returns Whether segments that were there have changed.
	*/
	add({ first = 0, vertices, parents, changed = [], links = [] }) {
		const replaces = first === 0;
		if (replaces) this.edges = new Floats();
		else if (first !== this.vertices) throw new RangeError(`increment from vertex ${first} after ${this.vertices}`);
		this.append(vertices, parents);
		for (let i = 0; i + 1 < changed.length; i += 2) this.hang(changed[i], changed[i + 1]);
		const hadLinks = this.roadmap.length > 0;
		this.roadmap = new Floats();
		for (let i = 0; i + 1 < links.length; i += 2) this.roadmap.push4(...this.at(links[i]), ...this.at(links[i + 1]));
		return replaces || changed.length > 0 || links.length > 0 || hadLinks;
	}
	append(vertices, parents) {
		const first = this.vertices;
		for (let i = 0; i < parents.length; i++) {
			const [x, y] = [vertices[2 * i], vertices[2 * i + 1]];
			this.edges.push4(x, y, x, y);
		}
		for (let i = 0; i < parents.length; i++) this.hang(first + i, parents[i]);
	}
	/** Makes a vertex the child of another. */
	hang(child, parent) {
		const to = this.at(child);
		this.edges.set4(4 * child, ...parent < 0 ? to : this.at(parent), ...to);
	}
	at(vertex) {
		const { view } = this.edges;
		return [view[4 * vertex + 2], view[4 * vertex + 3]];
	}
};
// src/draw/treeLayer.ts
/** Segments a stroke: one stroke of all would take the browser many times as long. */
var BATCH = 500;
var WIDTH$1 = .8;
var [LEAST_OPACITY, MOST_OPACITY] = [.22, .75];
/** Vertices up to which a tree is drawn with full opacity. */
var SPARSE = 600;
/** Edges that moved are drawn anew only after this many times what that took the last time. */
var PATIENCE = 8;
var TreeLayer = class {
	canvas = null;
	context = null;
	lines = new TreeLines();
	/** The view, size and colour of the image; null where there is none. */
	view = null;
	key = "";
	drawn = 0;
	stale = false;
	cost = 0;
	drawnAt = Number.NEGATIVE_INFINITY;
	clear() {
		this.lines = new TreeLines();
		this.view = null;
	}
	add(tree) {
		if (this.lines.add(tree)) this.stale = true;
		if (this.drawn > this.lines.vertices) this.view = null;
	}
	/** Whether the image lags behind and wants to be drawn again when there is time. */
	get lags() {
		return this.stale;
	}
	/** Draws on a context in device pixels. While the view `moves`, a former image is good enough. */
	draw(target, view, size, ratio, colour, moves) {
		if (this.lines.vertices === 0) return;
		const key = `${size.width} ${size.height} ${ratio} ${colour}`;
		const moved = this.view?.scale !== view.scale || this.view.centre !== view.centre;
		const patient = performance.now() - this.drawnAt < PATIENCE * this.cost;
		if (!this.view || key !== this.key || moved && !moves || this.stale && !patient) {
			this.drawAll(view, size, ratio, colour);
			this.key = key;
		} else this.drawNew(this.view, size, ratio, colour);
		const { scale, dx, dy } = between(this.view, view, size);
		target.setTransform(scale, 0, 0, scale, dx * ratio, dy * ratio);
		target.globalAlpha = opacity(this.lines.vertices);
		target.drawImage(this.canvas, 0, 0);
		target.globalAlpha = 1;
	}
	drawAll(view, size, ratio, colour) {
		const begun = performance.now();
		this.canvas ??= new OffscreenCanvas(1, 1);
		this.context ??= this.canvas.getContext("2d");
		this.canvas.width = Math.max(1, Math.round(size.width * ratio));
		this.canvas.height = Math.max(1, Math.round(size.height * ratio));
		this.view = view;
		this.drawn = 0;
		this.stale = false;
		this.drawNew(view, size, ratio, colour);
		strokeSegments(this.context, this.lines.links, 0);
		this.drawnAt = performance.now();
		this.cost = this.drawnAt - begun;
	}
	drawNew(view, size, ratio, colour) {
		const context = this.context;
		context.setTransform(...worldMatrix(view, size, ratio));
		context.strokeStyle = colour;
		context.lineWidth = WIDTH$1 / view.scale;
		strokeSegments(context, this.lines.segments, this.drawn);
		this.drawn = this.lines.vertices;
	}
};
function strokeSegments(context, segments, first) {
	for (let from = 4 * first; from < segments.length; from += 4 * BATCH) {
		context.beginPath();
		for (let i = from; i < Math.min(from + 4 * BATCH, segments.length); i += 4) {
			context.moveTo(segments[i], segments[i + 1]);
			context.lineTo(segments[i + 2], segments[i + 3]);
		}
		context.stroke();
	}
}
/** Lower for a dense tree, so that the heat map shows through. */
function opacity(vertices) {
	return Math.max(LEAST_OPACITY, MOST_OPACITY * Math.min(1, Math.sqrt(SPARSE / vertices)));
}
// src/app/trace.ts
var Trace = class {
	phase = "waiting";
	tree = new TreeLayer();
	region = null;
	path = [];
	length = null;
	vertices = 0;
	/** Of the search, without the proposal. */
	seconds = 0;
	history = [];
	response = null;
	clear() {
		this.tree.clear();
		this.region = null;
		this.path = [];
		this.length = null;
		this.vertices = 0;
		this.seconds = 0;
		this.history = [];
		this.response = null;
	}
	take({ event, data }) {
		if (event === "region") this.region = data;
		else if (event === "progress") this.takeProgress(data);
		else this.takeResult(data);
	}
	/** The result of a plan that was not streamed. */
	replace(response) {
		this.clear();
		this.takeResult(response);
	}
	takeProgress({ seconds, length, vertices, path, tree }) {
		if (path) this.path = path;
		if (tree) this.tree.add(tree);
		this.measure(seconds, length, vertices);
	}
	takeResult(response) {
		if (response.region) this.region = response.region;
		if (response.tree) this.tree.add(response.tree);
		this.path = response.path;
		this.measure(response.planning_seconds, response.length, response.vertices);
		this.response = response;
		this.phase = "done";
	}
	measure(seconds, length, vertices) {
		this.seconds = seconds;
		this.vertices = vertices;
		this.length = length;
		if (length !== null && length < (this.history.at(-1)?.length ?? Number.POSITIVE_INFINITY)) this.history.push({
			seconds,
			length
		});
	}
};
// src/app/planning.ts
/** Plans what the page shows: at leisure with progress, or again and again while one drags. */
/** Seconds that all runs together may search while one drags. */
var LIVE_SECONDS = .03;
/** Milliseconds until a busy server is asked again, and how often. */
var RETRY_AFTER = 300;
var TRIES = 10;
var Planning = class {
	client;
	changed;
	traces = [];
	/** Why there is no plan, if the server refused it. */
	error = null;
	best = none(null);
	controller = new AbortController();
	pending = null;
	/** Of the loop that plans for a moment, while there is one. */
	following = null;
	constructor(client, changed) {
		this.client = client;
		this.changed = changed;
	}
	/** The shortest path that any run has found for the present problem. */
	get bestPath() {
		return this.best.path;
	}
	/** Plans with progress, the runs one after the other so that their times compare. */
	async plan(job) {
		this.pending = null;
		const signal = this.begin(job);
		for (const trace of this.traces) trace.phase = "waiting";
		for (const [index, run] of job.runs.entries()) {
			const attempt = () => this.stream(job, run, this.traces[index], signal);
			if (!await this.succeeds(attempt, signal)) return;
		}
	}
	/** Plans for a moment. While one such plan runs, only the latest wish is remembered. */
	async follow(job) {
		this.pending = job;
		if (this.following && !this.following.aborted) return;
		const signal = this.begin(job);
		this.following = signal;
		while (this.pending && !signal.aborted) {
			const wish = this.pending;
			this.pending = null;
			await this.succeeds(() => this.glance(wish, signal), signal);
		}
		if (this.following === signal) this.following = null;
	}
	begin({ runs }) {
		this.controller.abort();
		this.controller = new AbortController();
		this.traces = runs.map((_, index) => this.traces[index] ?? new Trace());
		return this.controller.signal;
	}
	async stream(job, run, trace, signal) {
		const request = planRequest(job.problem, run, job.limits);
		trace.phase = "planning";
		this.changed();
		let first = true;
		for await (const event of this.client.planStream(request, signal)) {
			if (signal.aborted) return;
			if (first) trace.clear();
			first = false;
			trace.take(event);
			this.took(job, trace);
		}
	}
	async glance(job, signal) {
		const limits = {
			...job.limits,
			time: LIVE_SECONDS / job.runs.length
		};
		for (const [index, run] of job.runs.entries()) {
			const response = await this.client.plan(planRequest(job.problem, run, limits), signal);
			const trace = this.traces[index];
			trace.replace(response);
			this.took(job, trace);
		}
	}
	took({ problem }, { length, path }) {
		this.error = null;
		if (problem !== this.best.problem) this.best = none(problem);
		if (length !== null && length < this.best.length) this.best = {
			problem,
			length,
			path
		};
		this.changed();
	}
	/** Tries again while the server is busy, and keeps the error if it refuses. */
	async succeeds(attempt, signal) {
		for (let tries = 1;; tries++) try {
			await attempt();
			return !signal.aborted;
		} catch (error) {
			if (signal.aborted) return false;
			if (!(error instanceof ApiError)) throw error;
			if (error.status !== 429 || tries === TRIES) {
				this.fail(error);
				return false;
			}
			await new Promise((resolve) => setTimeout(resolve, RETRY_AFTER));
		}
	}
	fail(error) {
		this.error = error;
		this.best = none(null);
		for (const trace of this.traces) {
			trace.clear();
			trace.phase = "failed";
		}
		this.changed();
	}
};
function none(problem) {
	return {
		problem,
		length: Number.POSITIVE_INFINITY,
		path: []
	};
}
// src/app/state.ts
var Store = class {
	state;
	listeners = [];
	constructor(state) {
		this.state = state;
	}
	get current() {
		return this.state;
	}
	update(change) {
		const former = this.state;
		this.state = {
			...former,
			...change
		};
		for (const listener of this.listeners) listener(this.state, former);
	}
	subscribe(listener) {
		this.listeners.push(listener);
	}
};
// src/app/app.ts
/** What a visitor can do; the rest of the page shows the outcome. */
var DEFAULT_SIZES = {
	point: {
		radius: .1,
		turningRadius: .55
	},
	dubins: {
		radius: .2,
		turningRadius: .55
	},
	"reeds-shepp": {
		radius: .2,
		turningRadius: .55
	}
};
var MOST_RUNS = 4;
/** The first picture: the README's problem. */
var RESOLUTION = .05;
var FIRST_MAP = {
	kind: "indoor",
	seed: 6,
	width: 24,
	height: 24,
	resolution: RESOLUTION
};
var FIRST_ENDS = {
	start: {
		x: 19.1,
		y: 3.4,
		yaw: 1.57
	},
	goal: {
		x: 2,
		y: 22.4,
		yaw: 1.57
	}
};
var App = class {
	client;
	options;
	changed;
	store;
	planning;
	/** What went wrong with a map, in the server's words. */
	mapError = null;
	raster = null;
	maps;
	loaded = null;
	former = [];
	/** Strokes that the server does not know yet. */
	strokes = [];
	editing = Promise.resolve();
	constructor(client, options, changed) {
		this.client = client;
		this.options = options;
		this.changed = changed;
		this.maps = new Maps(client);
		this.planning = new Planning(client, changed);
		this.store = new Store({
			problem: null,
			runs: [this.defaultRun("point")],
			limits: {
				time: Math.min(1, options.limits.plan_seconds),
				seed: null
			},
			live: false
		});
		this.store.subscribe((next, former) => {
			this.changed();
			if (!next.problem) return;
			const { problem, runs, limits, live } = next;
			if (problem === former.problem && runs === former.runs && limits === former.limits && live === former.live) return;
			if (live) this.planning.follow({
				problem,
				runs,
				limits
			});
			else this.planning.plan({
				problem,
				runs,
				limits
			});
		});
	}
	/** The fragment of a link to what is shown. */
	get link() {
		const { problem, runs, limits } = this.store.current;
		if (!problem) return "";
		const { source, map, robot, start, goal } = problem;
		return encode({
			source,
			id: map.id,
			robot,
			start,
			goal,
			runs,
			limits
		});
	}
	async begin(fragment) {
		const shared = decode(fragment);
		if (shared) {
			const loaded = await this.attempt(() => this.maps.shared(shared));
			if (loaded) {
				const { robot, limits } = shared;
				const runs = this.allowedRuns(robot.kind, shared.runs.slice(0, this.mostRuns));
				this.former = [];
				this.show(loaded, shared, {
					limits,
					runs
				});
				return;
			}
		}
		const robot = {
			kind: "point",
			...DEFAULT_SIZES.point
		};
		const first = await this.attempt(() => this.maps.generate(FIRST_MAP), shared !== null);
		if (first) this.show(first, {
			robot,
			...FIRST_ENDS
		});
	}
	generate(kind, seed, side) {
		return this.replaceMap(() => this.maps.generate({
			kind,
			seed,
			width: side,
			height: side,
			resolution: RESOLUTION
		}));
	}
	upload(files, resolution) {
		return this.replaceMap(() => this.maps.upload(files, resolution));
	}
	open(info) {
		return this.replaceMap(() => this.maps.open(info));
	}
	/** Draws obstacles or erases them; several strokes are sent one after the other. */
	draw(stroke) {
		this.strokes = [...this.strokes, stroke];
		this.changed();
		this.editing = this.editing.then(async () => {
			const before = this.loaded;
			const after = await this.attempt(() => this.maps.edit(before, stroke));
			this.strokes = this.strokes.filter((other) => other !== stroke);
			if (after) {
				this.former.push(before);
				this.show(after, this.store.current.problem);
			}
			this.changed();
		});
	}
	get canUndo() {
		return this.former.length > 0;
	}
	undo() {
		const before = this.former.pop();
		if (before) this.show(before, this.store.current.problem);
	}
	/** Moves start or goal, to the edge of the map at most. */
	moveEnd(end, pose, live) {
		const { problem } = this.store.current;
		if (!problem) return;
		const moved = exactPose({
			...pose,
			...clampToMap(problem.map, pose)
		});
		this.store.update({
			problem: {
				...problem,
				[end]: moved
			},
			live
		});
	}
	swapEnds() {
		const { problem } = this.store.current;
		if (!problem) return;
		this.store.update({ problem: {
			...problem,
			start: problem.goal,
			goal: problem.start
		} });
	}
	rest() {
		if (this.store.current.live) this.store.update({ live: false });
	}
	setRobotKind(kind) {
		const { problem, runs } = this.store.current;
		if (!problem || problem.robot.kind === kind) return;
		const robot = {
			kind,
			...DEFAULT_SIZES[kind]
		};
		this.store.update({
			problem: {
				...problem,
				robot
			},
			runs: this.allowedRuns(kind, runs)
		});
	}
	setRobotSize(size, live) {
		const { problem } = this.store.current;
		if (!problem) return;
		this.store.update({
			problem: {
				...problem,
				robot: {
					...problem.robot,
					...size
				}
			},
			live
		});
	}
	setLimits(change) {
		this.store.update({ limits: {
			...this.store.current.limits,
			...change
		} });
	}
	setRun(index, change) {
		const runs = this.store.current.runs.map((run, i) => i === index ? {
			...run,
			...change
		} : run);
		this.store.update({ runs });
	}
	get mostRuns() {
		return Math.min(this.options.limits.runs_to_compare, MOST_RUNS);
	}
	get canAddRun() {
		return this.store.current.runs.length < this.mostRuns;
	}
	/** Adds a run that differs from those there are: unguided first, then other planners. */
	addRun() {
		const { runs, problem } = this.store.current;
		if (!problem || !this.canAddRun) return;
		const { planners, default_guide } = this.options.robots[problem.robot.kind];
		const wishes = [...runs.slice(0, 1).flatMap((run) => run.guide ? [{
			...run,
			guide: null
		}] : []), ...[
			"BITstar",
			"InformedRRTstar",
			"SST",
			"RRT",
			...planners
		].flatMap((planner) => planners.includes(planner) ? [{
			planner,
			guide: default_guide,
			exploration: 0
		}] : [])];
		const isNew = (wish) => !runs.some((run) => run.planner === wish.planner && run.guide === wish.guide);
		this.store.update({ runs: [...runs, wishes.find(isNew) ?? wishes[0]] });
	}
	removeRun(index) {
		const { runs } = this.store.current;
		this.planning.traces.splice(index, 1);
		this.store.update({ runs: runs.filter((_, i) => i !== index) });
	}
	planAgain() {
		this.store.update({ limits: { ...this.store.current.limits } });
	}
	/** Whether a point lies on the map. */
	contains({ x, y }) {
		const { problem } = this.store.current;
		if (!problem) return false;
		const local = toLocal(problem.map, {
			x,
			y
		});
		const { width, height } = problem.map;
		return local.x >= 0 && local.y >= 0 && local.x < width && local.y < height;
	}
	defaultRun(kind) {
		const { default_planner, default_guide } = this.options.robots[kind];
		return {
			planner: default_planner,
			guide: default_guide,
			exploration: 0
		};
	}
	/** The runs with what this robot does not have replaced; at least one. */
	allowedRuns(kind, runs) {
		const { planners, guides } = this.options.robots[kind];
		const standard = this.defaultRun(kind);
		if (runs.length === 0) return [standard];
		return runs.map(({ planner, guide, exploration }) => ({
			planner: planners.includes(planner) ? planner : standard.planner,
			guide: guide === null || guides.includes(guide) ? guide : standard.guide,
			exploration
		}));
	}
	async replaceMap(get) {
		const loaded = await this.attempt(get);
		if (!loaded) return;
		this.former = [];
		const { problem } = this.store.current;
		const robot = problem?.robot ?? {
			kind: "point",
			...DEFAULT_SIZES.point
		};
		this.show(loaded, {
			robot,
			...this.ends(loaded, robot)
		});
	}
	ends({ info, raster }, robot) {
		const [start, goal] = farApart(raster, info, robot.radius) ?? [{
			x: info.origin[0],
			y: info.origin[1]
		}, {
			x: info.origin[0],
			y: info.origin[1]
		}];
		const yaw = Math.atan2(goal.y - start.y, goal.x - start.x);
		return {
			start: exactPose({
				...start,
				yaw
			}),
			goal: exactPose({
				...goal,
				yaw
			})
		};
	}
	show(loaded, { robot, start, goal }, change = {}) {
		const { info: map, source, raster } = loaded;
		this.loaded = loaded;
		this.raster = raster;
		this.store.update({
			problem: {
				map,
				source,
				robot,
				start,
				goal
			},
			live: false,
			...change
		});
	}
	async attempt(action, keepError = false) {
		try {
			const value = await action();
			if (!keepError) this.mapError = null;
			return value;
		} catch (error) {
			if (!(error instanceof ApiError)) throw error;
			this.mapError = error;
			this.changed();
			return null;
		}
	}
};
// src/ui/dom.ts
/** Shorthands for the document. */
function byId(id) {
	const found = document.getElementById(id);
	if (!found) throw new Error(`no element #${id}`);
	return found;
}
/** An element with attributes and content. */
function make(tag, attributes = {}, ...content) {
	const element = document.createElement(tag);
	for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
	element.append(...content);
	return element;
}
/** Changes text only where it differs: what reads the page aloud need not start again. */
function setText(element, text) {
	if (element.textContent !== text) element.textContent = text;
}
/** Fills a list of choices and chooses one. */
function setChoices(select, choices, chosen) {
	const key = JSON.stringify(choices);
	if (select.dataset.choices !== key) {
		select.dataset.choices = key;
		select.replaceChildren(...choices.map(([value, label]) => new Option(label, value)));
	}
	select.value = chosen;
}
function save(name, content) {
	const link = make("a", {
		href: URL.createObjectURL(content),
		download: name
	});
	link.click();
	setTimeout(() => URL.revokeObjectURL(link.href), 1e4);
}
var hiding = 0;
/** Says something for a moment. */
function toast(text) {
	const element = byId("toast");
	element.textContent = text;
	element.hidden = false;
	clearTimeout(hiding);
	hiding = window.setTimeout(() => {
		element.hidden = true;
	}, 2500);
}
async function copy(text, done) {
	try {
		await navigator.clipboard.writeText(text);
		toast(done);
	} catch {
		toast("The browser does not let this page copy; the address bar holds the link.");
	}
}
// src/ui/alert.ts
var BLOCKED = {
	StartOccupied: "start",
	GoalOccupied: "goal"
};
var Alert = class {
	app;
	box = byId("alert");
	fix = byId("alert-fix");
	/** The error that the visitor has read. */
	closed = null;
	constructor(app) {
		this.app = app;
		this.fix.addEventListener("click", () => this.moveToFree());
		byId("alert-close").addEventListener("click", () => {
			this.closed = this.error;
			this.update();
		});
	}
	update() {
		const { error } = this;
		this.box.hidden = error === null || error === this.closed;
		if (error === null) return;
		setText(byId("alert-text"), sentence(error.message));
		const end = error.nearestFree && BLOCKED[error.kind];
		this.fix.hidden = !end;
		if (end) setText(this.fix, `Move the ${end} to the nearest free point`);
	}
	get error() {
		return this.app.mapError ?? this.app.planning.error;
	}
	moveToFree() {
		const { error } = this;
		const end = error && BLOCKED[error.kind];
		const { problem } = this.app.store.current;
		if (!end || !error.nearestFree || !problem) return;
		const [x, y] = error.nearestFree;
		this.app.moveEnd(end, {
			...problem[end],
			x,
			y
		}, false);
	}
};
function sentence(text) {
	const trimmed = text.trim();
	const begun = trimmed.charAt(0).toUpperCase() + trimmed.slice(1);
	return /[.!?]$/.test(begun) ? begun : `${begun}.`;
}
// src/ui/chart.ts
var [WIDTH, HEIGHT] = [720, 220];
var AREA = {
	left: 52,
	right: 610,
	top: 12,
	bottom: 184
};
/** Told apart without colours, too. */
var DASHES = [
	"",
	"7 4",
	"2 3",
	"10 3 2 3"
];
var SVG = "http://www.w3.org/2000/svg";
/** Round numbers from low to high, about `wanted` of them. */
function ticks(low, high, wanted) {
	const raw = (high - low) / wanted;
	const power = 10 ** Math.floor(Math.log10(raw));
	const step = [
		1,
		2,
		5,
		10
	].map((factor) => factor * power).find((value) => value >= raw);
	const first = Math.ceil(low / step - 1e-9);
	const last = Math.floor(high / step + 1e-9);
	return Array.from({ length: last - first + 1 }, (_, index) => (first + index) * step);
}
/** Null where no run has found a path. */
function chart(runs, traces, colours) {
	const lengths = traces.flatMap((trace) => trace.history.map(({ length }) => length));
	if (lengths.length === 0) return null;
	const margin = Math.max(.06 * (Math.max(...lengths) - Math.min(...lengths)), .02);
	const y = {
		low: Math.min(...lengths) - margin,
		high: Math.max(...lengths) + margin
	};
	const x = {
		low: 0,
		high: Math.max(.01, ...traces.map((trace) => trace.seconds))
	};
	const svg = node("svg", {
		viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
		role: "img"
	});
	svg.append(node("title", {}, summary(runs, traces)));
	drawAxes(svg, x, y);
	const labels = [];
	traces.forEach((trace, index) => {
		const last = trace.history.at(-1);
		if (!last) return;
		const colour = colours.runs[index];
		svg.append(stepLine(trace, x, y, colour, DASHES[index]));
		labels.push({
			y: down(y, last.length),
			text: runs[index].planner,
			colour
		});
	});
	for (const label of spread(labels, 15)) svg.append(node("text", {
		x: AREA.right + 8,
		y: label.y + 4,
		style: `fill: ${label.colour}`
	}, label.text));
	return svg;
}
function across({ low, high }, value) {
	return AREA.left + (value - low) / (high - low) * (AREA.right - AREA.left);
}
function down({ low, high }, value) {
	return AREA.bottom - (value - low) / (high - low) * (AREA.bottom - AREA.top);
}
function drawAxes(svg, x, y) {
	for (const value of ticks(y.low, y.high, 4)) {
		const at = down(y, value);
		svg.append(node("line", {
			class: "grid",
			x1: AREA.left,
			x2: AREA.right,
			y1: at,
			y2: at
		}), node("text", {
			x: AREA.left - 8,
			y: at + 4,
			"text-anchor": "end"
		}, short(value)));
	}
	for (const value of ticks(x.low, x.high, 5)) {
		const at = across(x, value);
		svg.append(node("text", {
			x: at,
			y: AREA.bottom + 18,
			"text-anchor": "middle"
		}, short(value)));
	}
	svg.append(node("text", {
		x: AREA.right,
		y: AREA.bottom + 34,
		"text-anchor": "end"
	}, "seconds of search"), node("text", {
		x: 8,
		y: AREA.bottom + 34
	}, "metres"));
}
function stepLine({ history, seconds }, x, y, colour, dashes) {
	return node("path", {
		d: `${history.map(({ seconds: at, length }, index) => {
			const [px, py] = [across(x, at).toFixed(1), down(y, length).toFixed(1)];
			return index === 0 ? `M${px} ${py}` : `H${px}V${py}`;
		}).join("")}H${across(x, seconds).toFixed(1)}`,
		fill: "none",
		stroke: colour,
		"stroke-width": 2,
		"stroke-dasharray": dashes,
		"stroke-linejoin": "round"
	});
}
/** Moves labels apart so that none covers another. */
function spread(labels, distance) {
	const sorted = labels.map((label) => ({ ...label })).sort((a, b) => a.y - b.y);
	for (let i = 1; i < sorted.length; i++) sorted[i].y = Math.max(sorted[i].y, sorted[i - 1].y + distance);
	return sorted;
}
function summary(runs, traces) {
	return traces.map(({ history }, index) => {
		const [first, last] = [history[0], history.at(-1)];
		const name = runs[index]?.planner ?? "";
		if (!first || !last) return `${name}: no path`;
		return `${name}: ${`${first.length.toFixed(2)} m after ${first.seconds.toFixed(2)} s`}, ${last.length.toFixed(2)} m at the end`;
	}).join("; ");
}
function short(value) {
	return String(Number(value.toPrecision(6)));
}
function node(tag, attributes, text = "") {
	const element = document.createElementNS(SVG, tag);
	for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
	element.textContent = text;
	return element;
}
// src/ui/words.ts
/** Numbers in words. */
function seconds(value) {
	return value >= 1 ? `${value.toFixed(2)} s` : `${(value * 1e3).toPrecision(3)} ms`;
}
function metres(value) {
	return `${value.toFixed(2)} m`;
}
function count(value) {
	return value.toLocaleString("en-US");
}
// src/ui/controls.ts
var OTHER = "";
var Controls = class {
	app;
	upload;
	mapSeed = byId("map-seed");
	mapSide = byId("map-side");
	files = byId("upload-files");
	maps = byId("maps");
	radius = byId("radius");
	turning = byId("turning");
	time = byId("time");
	seed = byId("seed");
	known = [];
	constructor(app, stage, upload) {
		this.app = app;
		this.upload = upload;
		byId("controls").addEventListener("submit", (event) => event.preventDefault());
		this.time.max = String(app.options.limits.plan_seconds);
		this.listenToMaps();
		this.listenToRobot();
		this.listenToSearch();
		for (const box of document.querySelectorAll("[data-layer]")) box.addEventListener("change", () => {
			stage.layers[box.dataset.layer] = box.checked;
			stage.invalidate();
		});
	}
	/** Metres a cell for files that do not say; null for the default. */
	get resolution() {
		const { value } = byId("map-resolution");
		return value === "" ? null : Number(value);
	}
	update() {
		const { problem, limits } = this.app.store.current;
		setValue(this.time, limits.time);
		setText(byId("time-value"), `${limits.time.toFixed(1)} s`);
		setValue(this.seed, limits.seed ?? "");
		if (!problem) return;
		const { robot, source, map } = problem;
		const kind = document.querySelector(`[name=robot][value=${robot.kind}]`);
		kind.checked = true;
		setValue(this.radius, robot.radius);
		setText(byId("radius-value"), metres(robot.radius));
		byId("turning-field").hidden = !isCar(robot);
		setValue(this.turning, robot.turningRadius);
		setText(byId("turning-value"), metres(robot.turningRadius));
		if (source.kind === "generated") {
			setValue(this.mapSeed, source.request.seed);
			setValue(this.mapSide, source.request.width);
		}
		this.maps.value = this.known.some(({ id }) => id === map.id) ? map.id : OTHER;
	}
	/** Asks the server which maps it has. */
	async refreshMaps() {
		this.known = await this.app.client.maps();
		byId("maps-field").hidden = this.known.length === 0;
		const choices = this.known.map(({ id, name }) => [id, name]);
		setChoices(this.maps, [[OTHER, "choose…"], ...choices], OTHER);
		this.update();
	}
	listenToMaps() {
		const { app } = this;
		let kind = "indoor";
		const generate = async () => {
			if (!this.mapSeed.checkValidity() || !this.mapSide.checkValidity()) return;
			await app.generate(kind, Number(this.mapSeed.value), Number(this.mapSide.value));
		};
		for (const button of document.querySelectorAll("[data-generate]")) button.addEventListener("click", () => {
			const wanted = button.dataset.generate;
			const { source } = app.store.current.problem ?? {};
			if (source?.kind === "generated" && source.request.kind === wanted && Number(this.mapSeed.value) === source.request.seed) this.mapSeed.value = String(source.request.seed + 1);
			kind = wanted;
			generate();
		});
		for (const input of [this.mapSeed, this.mapSide]) input.addEventListener("change", () => {
			const { source } = app.store.current.problem ?? {};
			if (source?.kind === "generated") kind = source.request.kind;
			generate();
		});
		byId("upload").addEventListener("click", () => this.files.click());
		this.files.addEventListener("change", async () => {
			await this.upload([...this.files.files ?? []]);
			this.files.value = "";
		});
		this.maps.addEventListener("change", () => {
			const chosen = this.known.find(({ id }) => id === this.maps.value);
			if (chosen) app.open(chosen);
		});
	}
	listenToRobot() {
		const { app } = this;
		for (const radio of document.querySelectorAll("[name=robot]")) radio.addEventListener("change", () => app.setRobotKind(radio.value));
		this.onSlide(this.radius, (radius) => app.setRobotSize({ radius }, true));
		this.onSlide(this.turning, (turningRadius) => app.setRobotSize({ turningRadius }, true));
	}
	listenToSearch() {
		const { app } = this;
		this.time.addEventListener("input", () => setText(byId("time-value"), `${Number(this.time.value).toFixed(1)} s`));
		this.time.addEventListener("change", () => app.setLimits({ time: Number(this.time.value) }));
		this.seed.addEventListener("change", () => {
			if (!this.seed.checkValidity()) return;
			app.setLimits({ seed: this.seed.value === "" ? null : Number(this.seed.value) });
		});
		byId("plan").addEventListener("click", () => app.planAgain());
		byId("add-run").addEventListener("click", () => app.addRun());
	}
	/** While a slider moves, plans follow it. */
	onSlide(slider, move) {
		slider.addEventListener("input", () => move(Number(slider.value)));
		slider.addEventListener("change", () => this.app.rest());
	}
};
/** Leaves alone what the visitor is typing. */
function setValue(input, value) {
	if (input === document.activeElement && input.type === "number") return;
	if (input.value !== String(value)) input.value = String(value);
}
// src/ui/drop.ts
/** Map files that are dropped anywhere on the page. */
function listenToDrops(upload) {
	const sign = byId("drop");
	const holdsFiles = (event) => event.dataTransfer?.types.includes("Files") ?? false;
	document.addEventListener("dragover", (event) => {
		if (!holdsFiles(event)) return;
		event.preventDefault();
		sign.hidden = false;
	});
	document.addEventListener("dragleave", (event) => {
		if (event.relatedTarget === null) sign.hidden = true;
	});
	document.addEventListener("drop", (event) => {
		if (!holdsFiles(event)) return;
		event.preventDefault();
		sign.hidden = true;
		upload([...event.dataTransfer?.files ?? []]);
	});
}
// src/model/files.ts
function pathCsv({ path }) {
	return `${[(path[0] ?? []).length > 2 ? "x,y,yaw" : "x,y", ...path.map((state) => state.join(","))].join("\n")}\n`;
}
function pathJson(problem, run, limits, response) {
	const { solved, status, length, vertices, planning_seconds, proposal_seconds, seed } = response;
	const { map, robot, start, goal } = problem;
	const record = {
		solved,
		status,
		length,
		vertices,
		planning_seconds,
		proposal_seconds,
		planner: run.planner,
		guide: run.guide,
		exploration: run.exploration,
		time_limit: limits.time,
		seed,
		start: wireState(robot, start),
		goal: wireState(robot, goal),
		robot: wireRobot(robot),
		map: {
			id: map.id,
			name: map.name,
			shape: [map.rows, map.columns],
			resolution: map.resolution,
			origin: map.origin
		},
		path: response.path
	};
	return `${JSON.stringify(record, null, 2)}\n`;
}
// src/model/snippet.ts
var CLASSES = {
	point: "PointRobot",
	dubins: "DubinsCar",
	"reeds-shepp": "ReedsSheppCar"
};
function snippet({ problem, run, limits, imageUrl }) {
	const { robot, start, goal } = problem;
	const generated = problem.source.kind === "generated" && problem.source.strokes.length === 0;
	const options = [
		`planner=${text(run.planner)}`,
		`guide=${run.guide === null ? "None" : text(run.guide)}`,
		...run.guide !== null && run.exploration > 0 ? [`exploration=${run.exploration}`] : [],
		`time_limit=${limits.time}`,
		...limits.seed === null ? [] : [`seed=${limits.seed}`]
	];
	return [
		...generated ? [] : [
			"from io import BytesIO",
			"from urllib.request import urlopen",
			""
		],
		...generated ? [] : [
			"import numpy as np",
			"from PIL import Image",
			""
		],
		"import planformer as pf",
		"",
		...generated ? generatedMap(problem) : fetchedMap(problem, imageUrl),
		`robot = ${robotCall(robot)}`,
		"result = pf.plan(",
		"    grid,",
		"    robot,",
		`    start=${tuple(robot, start)},`,
		`    goal=${tuple(robot, goal)},`,
		...options.map((option) => `    ${option},`),
		")",
		"print(result)",
		"print(result.path)",
		""
	].join("\n");
}
function generatedMap({ source }) {
	if (source.kind !== "generated") return [];
	const { kind, seed, width, height, resolution } = source.request;
	return [`grid = pf.generate_${kind}(seed=${seed}, ${`width=${width}, height=${height}, resolution=${resolution}`})`];
}
function fetchedMap({ map }, imageUrl) {
	return [
		`# ${JSON.stringify(map.name).slice(1, -1)}, from the server of the page; the picture's first row is the highest y.`,
		`with urlopen(${text(imageUrl)}) as response:`,
		"    pixels = np.asarray(Image.open(BytesIO(response.read())))[::-1]",
		"grid = pf.OccupancyGrid(",
		"    pixels < 255,",
		`    resolution=${map.resolution},`,
		`    origin=(${map.origin.join(", ")}),`,
		"    unknown=pixels == 127,",
		")"
	];
}
function robotCall(robot) {
	const turning = isCar(robot) ? `, turning_radius=${robot.turningRadius}` : "";
	return `pf.${CLASSES[robot.kind]}(radius=${robot.radius}${turning})`;
}
function tuple(robot, { x, y, yaw }) {
	return `(${[
		x,
		y,
		...isCar(robot) ? [yaw] : []
	].join(", ")})`;
}
/** A JSON string is a Python string as well. */
function text(value) {
	return JSON.stringify(value);
}
// src/ui/exports.ts
var HEADLINE = 34;
var GAP = 16;
var Exports = class {
	app;
	stage;
	menu = byId("export");
	dialog = byId("code-dialog");
	constructor(app, stage) {
		this.app = app;
		this.stage = stage;
		byId("share").addEventListener("click", () => void this.copyLink());
		this.onItem("export-csv", () => this.savePaths("csv", "text/csv"));
		this.onItem("export-json", () => this.savePaths("json", "application/json"));
		this.onItem("export-picture", () => this.savePicture());
		this.onItem("export-python", () => this.showProgram());
		byId("code-copy").addEventListener("click", () => void copy(this.program, "Program copied"));
		byId("code-save").addEventListener("click", () => save("plan.py", new Blob([this.program], { type: "text/x-python" })));
		document.addEventListener("click", (event) => {
			if (!this.menu.contains(event.target)) this.menu.open = false;
		});
	}
	copyLink() {
		return copy(new URL(this.app.link, location.href).href, "Link copied");
	}
	onItem(id, action) {
		byId(id).addEventListener("click", () => {
			this.menu.open = false;
			action();
		});
	}
	/** Of the first run: the others' programs differ by a name. */
	get program() {
		return byId("code").textContent ?? "";
	}
	showProgram() {
		const { problem, runs, limits } = this.app.store.current;
		if (!problem) return;
		const seed = limits.seed ?? this.app.planning.traces[0]?.response?.seed ?? null;
		byId("code").textContent = snippet({
			problem,
			run: runs[0],
			limits: {
				...limits,
				seed
			},
			imageUrl: this.app.client.imageUrl(problem.map.id)
		});
		this.dialog.showModal();
	}
	savePaths(suffix, type) {
		const { problem, runs, limits } = this.app.store.current;
		const found = this.finished().filter(({ trace }) => trace.response.solved);
		if (!problem || found.length === 0) {
			toast("There is no path yet.");
			return;
		}
		for (const { trace, run, index } of found) {
			const response = trace.response;
			const text = suffix === "csv" ? pathCsv(response) : pathJson(problem, run, limits, response);
			save(`path${runs.length > 1 ? `-${index + 1}-${run.planner}` : ""}.${suffix}`, new Blob([text], { type }));
		}
	}
	finished() {
		const { runs } = this.app.store.current;
		return runs.flatMap((run, index) => {
			const trace = this.app.planning.traces[index];
			return trace?.response ? [{
				trace,
				run,
				index
			}] : [];
		});
	}
	/** All panels as they are, each under a line that says what it shows. */
	savePicture() {
		const { runs } = this.app.store.current;
		const { panels, colours } = this.stage;
		const [first] = panels;
		if (!first) return;
		const ratio = window.devicePixelRatio;
		const columns = Math.min(panels.length, 2);
		const width = first.canvas.width + GAP * ratio;
		const height = first.canvas.height + 50 * ratio;
		const canvas = new OffscreenCanvas(columns * width + GAP * ratio, Math.ceil(panels.length / columns) * height + GAP * ratio);
		const context = canvas.getContext("2d");
		const style = getComputedStyle(document.documentElement);
		context.fillStyle = style.backgroundColor;
		context.fillRect(0, 0, canvas.width, canvas.height);
		context.font = `${15 * ratio}px ${style.fontFamily}`;
		panels.forEach((panel, index) => {
			const x = GAP * ratio + index % columns * width;
			const y = GAP * ratio + Math.floor(index / columns) * height;
			context.fillStyle = colours.runs[index];
			context.fillText(headline(runs[index], this.app.planning.traces[index]), x, y + 18 * ratio);
			context.drawImage(panel.canvas, x, y + HEADLINE * ratio);
		});
		canvas.convertToBlob({ type: "image/png" }).then((blob) => save("plan.png", blob));
	}
};
function headline(run, trace) {
	const guide = run.guide === null ? "unguided" : `guided by ${run.guide}`;
	const length = trace?.length == null ? "no path" : metres(trace.length);
	return `${run.planner}, ${guide}: ${length}, ${count(trace?.vertices ?? 0)} vertices`;
}
// src/ui/keys.ts
var TOOLS = {
	v: "move",
	s: "start",
	g: "goal",
	w: "wall",
	e: "erase"
};
function listenToKeys({ app, stage, toolbar, exports }) {
	const help = byId("help-dialog");
	byId("help").addEventListener("click", () => help.showModal());
	const actions = {
		x: () => app.swapEnds(),
		c: () => app.addRun(),
		l: () => void exports.copyLink(),
		"?": () => help.showModal(),
		"+": () => stage.zoom(1),
		"=": () => stage.zoom(1),
		"-": () => stage.zoom(-1),
		"0": () => stage.fit(),
		" ": () => stage.drive(),
		Enter: () => app.planAgain(),
		Escape: () => toolbar.choose("move")
	};
	document.addEventListener("keydown", (event) => {
		if (document.querySelector("dialog[open]") || event.altKey || isTyping(event)) return;
		const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
		if (event.ctrlKey || event.metaKey) {
			if (key !== "z") return;
			app.undo();
		} else if (TOOLS[key]) toolbar.choose(TOOLS[key]);
		else if (actions[key]) actions[key]();
		else return;
		event.preventDefault();
	});
}
/** Whether the key belongs to the element that has the focus. */
function isTyping(event) {
	const target = event.target;
	if (target.matches("input[type=number], select, textarea")) return true;
	return (event.key === " " || event.key === "Enter") && target.matches("button:not(.handle), summary, a, input");
}
// src/draw/palette.ts
var LIGHT = {
	floor: "#fbf8f1",
	obstacle: "#2b3441",
	unknown: "#bdc1c5",
	tree: "#3f6b8f",
	halo: "#ffffff",
	region: "#a3357a",
	start: "#00a67d",
	goal: "#d81e4a",
	alarm: "#c22f3d",
	best: "#20262e",
	runs: [
		"#1257d6",
		"#b85c00",
		"#8a2be2",
		"#00745a"
	],
	heatReversed: false
};
var DARK = {
	floor: "#181d24",
	obstacle: "#76869a",
	unknown: "#3a424d",
	tree: "#86b4dc",
	halo: "#0c1015",
	region: "#f08cc4",
	start: "#1fd1a1",
	goal: "#ff5d80",
	alarm: "#ff7a86",
	best: "#f2f4f7",
	runs: [
		"#6ea6ff",
		"#ffa94d",
		"#c89bff",
		"#3fd6a8"
	],
	heatReversed: true
};
function palette(theme) {
	return theme === "dark" ? DARK : LIGHT;
}
/** Matplotlib's plasma between 0.95 and 0.42, as in the library's pictures. */
var HEAT = [
	[
		247,
		228,
		37
	],
	[
		253,
		200,
		39
	],
	[
		253,
		174,
		50
	],
	[
		248,
		149,
		64
	],
	[
		240,
		127,
		79
	],
	[
		229,
		106,
		93
	],
	[
		215,
		86,
		108
	],
	[
		200,
		67,
		123
	],
	[
		182,
		48,
		139
	]
];
var OPACITY = .88;
/** Probability from which the heat is as opaque as it gets. */
var FULL_FROM = .55;
/** Red, green, blue and opacity, 0 to 255, of a probability. */
function heat(probability, reversed) {
	const position = (reversed ? 1 - probability : probability) * (HEAT.length - 1);
	const index = Math.min(Math.floor(position), HEAT.length - 2);
	const share = position - index;
	const [low, high] = [HEAT[index], HEAT[index + 1]];
	const ramp = Math.min(probability / FULL_FROM, 1);
	const mix = (channel) => low[channel] + share * (high[channel] - low[channel]);
	return [
		mix(0),
		mix(1),
		mix(2),
		255 * OPACITY * ramp * ramp * (3 - 2 * ramp)
	];
}
/** Red, green and blue, 0 to 255, of a colour like "#fbf8f1". */
function rgb(colour) {
	const value = Number.parseInt(colour.slice(1), 16);
	return [
		value >> 16,
		value >> 8 & 255,
		value & 255
	];
}
// src/draw/rasters.ts
/** Draws in the world frame, with smooth or with crisp pixels. */
function drawPlaced(context, map, placed, smooth) {
	const { image, left, bottom, width, height } = placed;
	context.save();
	inMapFrame(context, map);
	context.translate(left, bottom + height);
	context.scale(width / image.width, -height / image.height);
	context.imageSmoothingEnabled = smooth;
	context.imageSmoothingQuality = "medium";
	context.drawImage(image, 0, 0);
	context.restore();
}
/** Fills the map's rectangle. */
function fillMap(context, map, colour) {
	context.save();
	inMapFrame(context, map);
	context.fillStyle = colour;
	context.fillRect(0, 0, map.width, map.height);
	context.restore();
}
/** Nothing beside the map is drawn until the context is restored. */
function clipToMap(context, map) {
	const transform = context.getTransform();
	inMapFrame(context, map);
	context.beginPath();
	context.rect(0, 0, map.width, map.height);
	context.clip();
	context.setTransform(transform);
}
function inMapFrame(context, { origin: [x, y, yaw] }) {
	context.translate(x, y);
	context.rotate(yaw);
}
function onWholeMap(image, { width, height }) {
	return {
		image,
		left: 0,
		bottom: 0,
		width,
		height
	};
}
/** Obstacles and unknown space; what is free is transparent. */
function obstacles(map, raster, colours) {
	const { columns, rows, cells } = raster;
	const wall = packed([...rgb(colours.obstacle), 255]);
	const unseen = packed([...rgb(colours.unknown), 255]);
	return onWholeMap(painted(columns, rows, (index) => {
		const cell = cells[index];
		if (cell === 255) return TRANSPARENT;
		return cell === 127 ? unseen : wall;
	}), map);
}
/** The probability of each anchor, to be drawn smoothly. */
function heatMap(map, region, colours) {
	const { rows, columns, probability, anchors, anchor_size } = region;
	const image = painted(columns, rows, (index) => {
		const row = rows - 1 - Math.floor(index / columns);
		return packed(heat(probability[row * columns + index % columns], colours.heatReversed));
	});
	const at = (index) => {
		const [x, y] = anchors[index];
		return toLocal(map, {
			x,
			y
		});
	};
	const corner = at(0);
	const dx = columns > 1 ? at(1).x - corner.x : anchor_size;
	const dy = rows > 1 ? at(columns).y - corner.y : anchor_size;
	return {
		image,
		left: corner.x - dx / 2,
		bottom: corner.y - dy / 2,
		width: dx * columns,
		height: dy * rows
	};
}
async function decodeMask(base64) {
	const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
	const { width, height, data } = await imagePixels(new Blob([bytes], { type: "image/png" }));
	const inside = new Uint8Array(width * height);
	for (let i = 0; i < inside.length; i++) inside[i] = data[4 * i] > 127 ? 1 : 0;
	return {
		columns: width,
		rows: height,
		inside
	};
}
var REGION_FILL = 26;
var REGION_EDGE = 200;
/** The region: a tint with an outline a cell wide. */
function regionImage(map, mask, colours) {
	const { columns, rows, inside } = mask;
	const fill = packed([...rgb(colours.region), REGION_FILL]);
	const edge = packed([...rgb(colours.region), REGION_EDGE]);
	return onWholeMap(painted(columns, rows, (index) => {
		if (inside[index] === 0) return TRANSPARENT;
		const column = index % columns;
		return (column === 0 || inside[index - 1] === 1) && (column === columns - 1 || inside[index + 1] === 1) && (index < columns || inside[index - columns] === 1) && (index >= columns * (rows - 1) || inside[index + columns] === 1) ? fill : edge;
	}), map);
}
var TRANSPARENT = 0;
/** A colour as the 32 bits of a pixel, on a little-endian machine as all with browsers are. */
function packed([red, green, blue, alpha]) {
	return (alpha << 24 | blue << 16 | green << 8 | red) >>> 0;
}
/** A canvas whose pixels have the colours that a function gives. */
function painted(columns, rows, colourOf) {
	const canvas = new OffscreenCanvas(columns, rows);
	const context = canvas.getContext("2d");
	const image = context.createImageData(columns, rows);
	const pixels = new Uint32Array(image.data.buffer);
	for (let i = 0; i < pixels.length; i++) pixels[i] = colourOf(i);
	context.putImageData(image, 0, 0);
	return canvas;
}
// src/geometry/path.ts
/** Polylines of positions (x, y) or poses (x, y, yaw). */
/** Length along the path to each of its states. */
function lengths(path) {
	let total = 0;
	return path.map(([x, y], index) => {
		const former = path[index - 1];
		if (former) total += Math.hypot(x - former[0], y - former[1]);
		return total;
	});
}
/** Follows a path at any length along it. */
var Walker = class {
	path;
	along;
	constructor(path) {
		this.path = path;
		this.along = lengths(path);
	}
	get length() {
		return this.along.at(-1) ?? 0;
	}
	/** The pose after `length` metres; a position's yaw is the direction of travel. */
	at(length) {
		const last = this.path.length - 1;
		if (last < 1) return pose(this.path[0]);
		const index = Math.min(this.segment(length), last - 1);
		const [from, to] = [pose(this.path[index]), pose(this.path[index + 1])];
		const step = this.along[index + 1] - this.along[index];
		const share = step > 0 ? Math.min(Math.max((length - this.along[index]) / step, 0), 1) : 1;
		return {
			x: from.x + share * (to.x - from.x),
			y: from.y + share * (to.y - from.y),
			yaw: this.path[0].length > 2 ? wrapAngle(from.yaw + share * wrapAngle(to.yaw - from.yaw)) : Math.atan2(to.y - from.y, to.x - from.x)
		};
	}
	/** Index of the segment that holds a length, by bisection. */
	segment(length) {
		let [low, high] = [0, this.along.length - 1];
		while (high - low > 1) {
			const middle = low + high >> 1;
			if (this.along[middle] <= length) low = middle;
			else high = middle;
		}
		return low;
	}
};
function pose(state) {
	return {
		x: state[0],
		y: state[1],
		yaw: state[2] ?? 0
	};
}
/** Outline of a car that fits into a disc, pointed at the front; as in the library's pictures. */
var CAR = [
	[.9, 0],
	[.62, .42],
	[-.9, .42],
	[-.9, -.42],
	[.62, -.42]
];
/** The outline of a car in a disc of radius `size` at a pose. */
function carOutline({ x, y, yaw }, size) {
	const [c, s] = [Math.cos(yaw) * size, Math.sin(yaw) * size];
	return CAR.map(([u, v]) => [x + c * u - s * v, y + s * u + c * v]);
}
/** Poses evenly spaced along a path, its ends left out. */
function along(path, spacing, most) {
	const walker = new Walker(path);
	const count = Math.min(most, Math.floor(walker.length / spacing));
	return Array.from({ length: count }, (_, index) => walker.at(walker.length * (index + 1) / (count + 1)));
}
// src/ui/gestures.ts
/** A press that moves fewer pixels is a click. */
var SLACK = 5;
var WHEEL_SPEED = .0015;
function listenToGestures(element, target) {
	const fingers = /* @__PURE__ */ new Map();
	let begun = null;
	let moved = false;
	const position = (event) => {
		const box = element.getBoundingClientRect();
		return {
			x: event.clientX - box.left,
			y: event.clientY - box.top
		};
	};
	element.addEventListener("pointerdown", (event) => {
		if (event.button !== 0) return;
		element.setPointerCapture(event.pointerId);
		const at = position(event);
		fingers.set(event.pointerId, at);
		if (fingers.size === 1) {
			begun = at;
			moved = false;
			target.dragStart(at);
		} else if (begun) {
			begun = null;
			target.dragEnd(at, true);
		}
	});
	element.addEventListener("pointermove", (event) => {
		const from = fingers.get(event.pointerId);
		if (!from) return;
		const at = position(event);
		if (fingers.size === 2) {
			const [first, second] = [...fingers.values()];
			fingers.set(event.pointerId, at);
			const [newFirst, newSecond] = [...fingers.values()];
			target.pinch(middle(first, second), middle(newFirst, newSecond), span(newFirst, newSecond) / Math.max(span(first, second), 1));
		} else if (begun) {
			moved ||= span(begun, at) > SLACK;
			fingers.set(event.pointerId, at);
			if (moved) target.dragMove(at, from);
		}
	});
	const end = (event, cancelled) => {
		if (!fingers.delete(event.pointerId) || !begun) return;
		begun = null;
		const at = position(event);
		target.dragEnd(at, cancelled);
		if (!moved && !cancelled) target.click(at);
	};
	element.addEventListener("pointerup", (event) => end(event, false));
	element.addEventListener("pointercancel", (event) => end(event, true));
	element.addEventListener("wheel", (event) => {
		event.preventDefault();
		const at = position(event);
		const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
		target.pinch(at, at, Math.exp(-event.deltaY * lines * WHEEL_SPEED));
	}, { passive: false });
}
function middle(a, b) {
	return {
		x: (a.x + b.x) / 2,
		y: (a.y + b.y) / 2
	};
}
function span(a, b) {
	return Math.hypot(a.x - b.x, a.y - b.y);
}
// src/draw/scene.ts
function drawScene(context, scene) {
	const { view, size, ratio, layers, map, colours } = scene;
	const inWorld = () => context.setTransform(...worldMatrix(view, size, ratio));
	context.setTransform(1, 0, 0, 1, 0, 0);
	context.clearRect(0, 0, context.canvas.width, context.canvas.height);
	inWorld();
	context.save();
	clipToMap(context, map);
	fillMap(context, map, colours.floor);
	if (layers.heat && scene.heat) drawPlaced(context, map, scene.heat, true);
	const smooth = (placed) => placed.width / placed.image.width * view.scale < 2;
	if (layers.region && scene.region) drawPlaced(context, map, scene.region, smooth(scene.region));
	drawPlaced(context, map, scene.obstacles, smooth(scene.obstacles));
	for (const stroke of scene.strokes) drawStroke(context, stroke, colours);
	context.restore();
	if (layers.tree) scene.tree.draw(context, view, size, ratio, colours.tree, scene.moves);
	inWorld();
	drawPaths(context, scene);
	drawEnds(context, scene);
	if (scene.driver) drawDriver(context, scene, scene.driver);
}
function drawStroke(context, stroke, colours) {
	const colour = stroke.occupied ? colours.obstacle : colours.floor;
	trace(context, stroke.points);
	context.strokeStyle = colour;
	context.lineWidth = 2 * stroke.radius;
	context.lineCap = "round";
	context.lineJoin = "round";
	context.stroke();
}
/** Begins a path along the points; a single one becomes a dot. */
function trace(context, path) {
	context.beginPath();
	path.forEach(([x, y], index) => {
		if (index === 0) context.moveTo(x, y);
		context.lineTo(x, y);
	});
}
function drawPaths(context, scene) {
	const { layers, robot, path, best, colours, pathColour, view } = scene;
	const pixel = 1 / view.scale;
	context.lineCap = "round";
	context.lineJoin = "round";
	if (layers.band && path.length > 1) {
		trace(context, path);
		context.globalAlpha = .2;
		line(context, pathColour, 2 * robot.radius);
		context.globalAlpha = 1;
	}
	if (layers.best && best.length > 1) {
		trace(context, best);
		context.setLineDash([2 * pixel, 6 * pixel]);
		line(context, colours.best, 3 * pixel);
		context.setLineDash([]);
	}
	if (layers.path && path.length > 1) {
		trace(context, path);
		line(context, colours.halo, 5.5 * pixel);
		line(context, pathColour, 2.6 * pixel);
		if (isCar(robot)) drawCars(context, scene);
	}
}
function line(context, colour, width) {
	context.strokeStyle = colour;
	context.lineWidth = width;
	context.stroke();
}
var MOST_CARS = 14;
/** A small robot on a large map is drawn larger than it is: its heading must be seen. */
function carSize({ robot, view }) {
	return Math.max(robot.radius, 7 / view.scale);
}
function drawCars(context, scene) {
	const size = carSize(scene);
	for (const pose of along(scene.path, 4 * size, MOST_CARS)) drawCar(context, pose, size, scene.colours.halo, scene.pathColour, 1.2 / scene.view.scale);
}
function drawCar(context, pose, size, fill, edge, width) {
	trace(context, carOutline(pose, size));
	context.closePath();
	context.fillStyle = fill;
	context.fill();
	line(context, edge, width);
}
function drawDriver(context, scene, pose) {
	const { colours, pathColour, robot, view } = scene;
	const pixel = 1 / view.scale;
	if (isCar(robot)) {
		drawCar(context, pose, 1.3 * carSize(scene), pathColour, colours.halo, 2 * pixel);
		return;
	}
	disc(context, pose, Math.max(robot.radius, 7 * pixel));
	context.fillStyle = pathColour;
	context.fill();
	line(context, colours.halo, 2 * pixel);
}
function disc(context, { x, y }, radius) {
	context.beginPath();
	context.arc(x, y, radius, 0, 2 * Math.PI);
}
/** Length in pixels of the arm that a heading handle sits on. */
function drawEnds(context, scene) {
	const { colours, robot, start, goal } = scene;
	for (const [pose, colour, isGoal] of [[
		start,
		colours.start,
		false
	], [
		goal,
		colours.goal,
		true
	]]) {
		drawFootprint(context, scene, pose, colour);
		if (isCar(robot)) drawDart(context, scene, pose, colour);
		else if (isGoal) drawStar(context, scene, pose, colour);
		else marker(context, scene, colour, () => disc(context, pose, 7.5 / scene.view.scale));
	}
}
/** The robot's disc, true to scale. */
function drawFootprint(context, { robot, view }, pose, colour) {
	disc(context, pose, robot.radius);
	context.globalAlpha = .25;
	context.fillStyle = colour;
	context.fill();
	context.globalAlpha = 1;
	line(context, colour, 1 / view.scale);
}
function marker(context, { colours, view }, colour, outline) {
	outline();
	line(context, colours.halo, 4 / view.scale);
	context.fillStyle = colour;
	context.fill();
}
function drawStar(context, scene, { x, y }, colour) {
	const points = Array.from({ length: 10 }, (_, index) => {
		const radius = (index % 2 === 0 ? 11 : 4.8) / scene.view.scale;
		const angle = Math.PI / 2 + index * Math.PI / 5;
		return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
	});
	marker(context, scene, colour, () => {
		trace(context, points);
		context.closePath();
	});
}
var DART = [
	[1, 0],
	[-.8, .72],
	[-.42, 0],
	[-.8, -.72]
];
/** An arrowhead along the heading, and the arm and knob that turn it. */
function drawDart(context, scene, { x, y, yaw }, colour) {
	const pixel = 1 / scene.view.scale;
	const [c, s] = [Math.cos(yaw) * pixel, Math.sin(yaw) * pixel];
	const at = (u, v) => [x + c * u - s * v, y + s * u + c * v];
	trace(context, [at(0, 0), at(34, 0)]);
	line(context, colour, 1.5 * pixel);
	const [knobX, knobY] = at(34, 0);
	marker(context, scene, colour, () => disc(context, {
		x: knobX,
		y: knobY,
		yaw
	}, 4.5 * pixel));
	marker(context, scene, colour, () => {
		trace(context, DART.map(([u, v]) => at(12 * u, 12 * v)));
		context.closePath();
	});
}
// src/ui/handles.ts
var TURN = 5 * Math.PI / 180;
var ARROWS = {
	ArrowLeft: [-1, 0],
	ArrowRight: [1, 0],
	ArrowUp: [0, 1],
	ArrowDown: [0, -1]
};
var Handles = class {
	app;
	parent;
	lens;
	buttons;
	knobs;
	constructor(app, parent, lens) {
		this.app = app;
		this.parent = parent;
		this.lens = lens;
		this.buttons = {
			start: this.button("start", false),
			goal: this.button("goal", false)
		};
		this.knobs = {
			start: this.button("start", true),
			goal: this.button("goal", true)
		};
		for (const end of ["start", "goal"]) {
			this.onDrag(this.buttons[end], (at, grip) => this.moveTo(end, at, grip));
			this.onDrag(this.knobs[end], (at) => this.turnTo(end, at));
			this.onKeys(end, this.buttons[end]);
			this.onKeys(end, this.knobs[end]);
		}
	}
	/** Puts the buttons where the ends are. */
	place() {
		const { problem } = this.app.store.current;
		if (!problem) return;
		const { view, size } = this.lens();
		const car = isCar(problem.robot);
		for (const end of ["start", "goal"]) {
			const pose = problem[end];
			const at = toScreen(view, size, pose);
			put(this.buttons[end], at);
			this.buttons[end].setAttribute("aria-label", label(end, pose, car));
			this.knobs[end].hidden = !car;
			put(this.knobs[end], {
				x: at.x + 34 * Math.cos(pose.yaw),
				y: at.y - 34 * Math.sin(pose.yaw)
			});
		}
	}
	button(end, turns) {
		const button = make("button", {
			type: "button",
			class: turns ? "handle heading" : "handle",
			"data-end": end,
			"aria-label": turns ? `Heading of the ${end}; comma and full stop turn it` : end
		});
		this.parent.append(button);
		return button;
	}
	onDrag(button, move) {
		/** From the handle's middle to where it was taken. */
		let grip = null;
		const position = (event) => {
			const box = this.parent.getBoundingClientRect();
			return {
				x: event.clientX - box.left,
				y: event.clientY - box.top
			};
		};
		button.addEventListener("pointerdown", (event) => {
			if (event.button !== 0) return;
			button.setPointerCapture(event.pointerId);
			const box = button.getBoundingClientRect();
			grip = {
				x: event.clientX - (box.left + box.width / 2),
				y: event.clientY - (box.top + box.height / 2)
			};
		});
		button.addEventListener("pointermove", (event) => {
			if (grip) move(position(event), grip);
		});
		const end = () => {
			grip = null;
			this.app.rest();
		};
		button.addEventListener("pointerup", end);
		button.addEventListener("pointercancel", end);
	}
	moveTo(end, at, grip) {
		const { problem } = this.app.store.current;
		if (!problem) return;
		const { view, size } = this.lens();
		const world = toWorld(view, size, {
			x: at.x - grip.x,
			y: at.y - grip.y
		});
		this.app.moveEnd(end, {
			...problem[end],
			...world
		}, true);
	}
	turnTo(end, at) {
		const { problem } = this.app.store.current;
		if (!problem) return;
		const { view, size } = this.lens();
		const world = toWorld(view, size, at);
		const pose = problem[end];
		const yaw = Math.atan2(world.y - pose.y, world.x - pose.x);
		this.app.moveEnd(end, {
			...pose,
			yaw
		}, true);
	}
	onKeys(end, button) {
		button.addEventListener("keydown", (event) => {
			const { problem } = this.app.store.current;
			if (!problem || event.ctrlKey || event.metaKey || event.altKey) return;
			const pose = problem[end];
			const arrow = ARROWS[event.key];
			const turn = isCar(problem.robot) ? {
				",": TURN,
				".": -TURN
			}[event.key] : void 0;
			if (arrow) {
				const step = problem.map.resolution * (event.shiftKey ? 10 : 1);
				const [x, y] = [pose.x + step * arrow[0], pose.y + step * arrow[1]];
				this.app.moveEnd(end, {
					...pose,
					x,
					y
				}, true);
			} else if (turn !== void 0) this.app.moveEnd(end, {
				...pose,
				yaw: wrapAngle(pose.yaw + turn)
			}, true);
			else return;
			event.preventDefault();
			event.stopPropagation();
		});
		button.addEventListener("keyup", () => this.app.rest());
		button.addEventListener("blur", () => this.app.rest());
	}
};
function put(button, { x, y }) {
	button.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
}
function label(end, { x, y, yaw }, car) {
	const heading = car ? `, heading ${(yaw * 180 / Math.PI).toFixed(0)} degrees` : "";
	return `${end} at ${x.toFixed(2)}, ${y.toFixed(2)} metres${heading}; arrow keys move it`;
}
// src/ui/panel.ts
var UNGUIDED = "none";
var EXPLORATION = [
	["0", "region only"],
	["0.1", "10 % outside"],
	["0.5", "half outside"]
];
var Panel = class {
	app;
	index;
	changed;
	element = make("article", { class: "panel" });
	view = make("div", { class: "view" });
	canvas = make("canvas");
	context = this.canvas.getContext("2d");
	handles;
	planner = make("select", { "aria-label": "Planner" });
	guide = make("select", { "aria-label": "Guide" });
	exploration = make("select", { "aria-label": "Samples outside the region" });
	remove = make("button", {
		type: "button",
		class: "icon remove",
		"aria-label": "Remove this planner"
	}, "×");
	figures;
	heat = memo(heatMap);
	region = memo(regionImage);
	decoding = null;
	decoded = null;
	constructor(app, index, lens, changed) {
		this.app = app;
		this.index = index;
		this.changed = changed;
		const figure = (name) => make("dd", { "data-figure": name });
		this.figures = {
			length: figure("length"),
			vertices: figure("vertices"),
			time: figure("time"),
			status: figure("status")
		};
		this.view.append(this.canvas);
		this.handles = new Handles(app, this.view, lens);
		this.element.append(make("header", {}, make("span", {
			class: "swatch",
			"aria-hidden": "true"
		}), this.planner, this.guide, this.exploration, this.remove), this.view, this.stats());
		this.listen();
	}
	/** Brings choices and figures up to date. */
	update(run, trace, colours) {
		const { problem, runs } = this.app.store.current;
		const robot = this.app.options.robots[problem?.robot.kind ?? "point"];
		const guided = !robot.unguided_planners.includes(run.planner);
		this.element.style.setProperty("--run", colours.runs[this.index]);
		this.element.setAttribute("aria-label", `${run.planner}, guide ${run.guide ?? UNGUIDED}`);
		setChoices(this.planner, robot.planners.map((name) => [name, name]), run.planner);
		const guides = [...robot.guides.map((name) => [name, `guide ${name}`]), [UNGUIDED, "unguided"]];
		setChoices(this.guide, guides, run.guide ?? UNGUIDED);
		setChoices(this.exploration, explorations(run.exploration), String(run.exploration));
		this.guide.hidden = !guided;
		this.exploration.hidden = !guided || run.guide === null;
		this.remove.hidden = runs.length === 1;
		this.canvas.setAttribute("role", "img");
		this.canvas.setAttribute("aria-label", describe(run, trace));
		this.showFigures(trace);
	}
	draw(shared, trace, driver) {
		const { size, ratio, map, colours, layers } = shared;
		const mask = layers.region && trace.region ? this.mask(trace.region) : null;
		const [width, height] = [Math.round(size.width * ratio), Math.round(size.height * ratio)];
		if (this.canvas.width !== width || this.canvas.height !== height) {
			this.canvas.width = width;
			this.canvas.height = height;
		}
		drawScene(this.context, {
			...shared,
			heat: trace.region && this.heat(map, trace.region, colours),
			region: mask && this.region(map, mask, colours),
			tree: trace.tree,
			path: trace.path,
			pathColour: colours.runs[this.index],
			driver
		});
		this.handles.place();
	}
	/** The region's mask; the last one until that of a new region is decoded. */
	mask(region) {
		if (region !== this.decoding) {
			this.decoding = region;
			decodeMask(region.mask).then((mask) => {
				this.decoded = mask;
				this.changed();
			});
		}
		return this.decoded;
	}
	stats() {
		const { length, vertices, time, status } = this.figures;
		return make("dl", { class: "stats" }, make("div", {}, make("dt", {}, "Length"), length), make("div", {}, make("dt", {}, "Vertices"), vertices), make("div", {}, make("dt", {}, "Time"), time), make("div", { class: "status" }, make("dt", { class: "hidden" }, "Status"), status));
	}
	listen() {
		const { app, index } = this;
		this.planner.addEventListener("change", () => app.setRun(index, { planner: this.planner.value }));
		this.guide.addEventListener("change", () => app.setRun(index, { guide: this.guide.value === UNGUIDED ? null : this.guide.value }));
		this.exploration.addEventListener("change", () => app.setRun(index, { exploration: Number(this.exploration.value) }));
		this.remove.addEventListener("click", () => app.removeRun(index));
	}
	showFigures(trace) {
		const known = trace && trace.vertices > 0;
		const { length, vertices, time, status } = this.figures;
		setText(length, known && trace.length !== null ? metres(trace.length) : "–");
		setText(vertices, known ? count(trace.vertices) : "–");
		setText(time, known ? times(trace) : "–");
		setText(status, trace ? statusText(trace) : "");
		status.parentElement.classList.toggle("failed", trace?.response?.solved === false);
	}
};
/** Planning time, and what the proposal took before it. */
function times({ seconds: planning, region, response }) {
	const proposal = response?.proposal_seconds ?? region?.proposal_seconds ?? 0;
	return proposal > 0 ? `${seconds(planning)} + ${seconds(proposal)} proposal` : seconds(planning);
}
function statusText({ phase, response }) {
	if (phase === "planning") return "searching…";
	if (phase === "waiting") return "waiting";
	if (!response) return "";
	return response.solved ? response.status : `no path: ${response.status}`;
}
function describe(run, trace) {
	return `Map with ${trace?.length == null ? "no path yet" : `a path of ${metres(trace.length)}`} by ${run.planner}`;
}
/** The usual shares, and that of a link if it is another. */
function explorations(chosen) {
	if (EXPLORATION.some(([value]) => Number(value) === chosen)) return [...EXPLORATION];
	return [...EXPLORATION, [String(chosen), `${(100 * chosen).toFixed(0)} % outside`]];
}
/** Remembers the last image for as long as it is made of the same objects. */
function memo(create) {
	let last = null;
	return (...from) => {
		if (!last || from.some((value, index) => value !== last.from[index])) last = {
			from,
			image: create(...from)
		};
		return last.image;
	};
}
// src/ui/stage.ts
var MARGIN = 10;
/** Milliseconds after which a moved view counts as at rest. */
var REST = 140;
/** Seconds that the robot takes along the longest path. */
var DRIVE_SECONDS = 6;
var ZOOM_STEP = 1.4;
var Stage = class {
	app;
	theme;
	layers = {
		heat: true,
		region: false,
		tree: true,
		path: true,
		band: true,
		best: false
	};
	tool = "move";
	brush = .25;
	onToolUsed = () => {};
	onDrive = () => {};
	panels = [];
	parent = byId("panels");
	size = {
		width: 1,
		height: 1
	};
	view = {
		centre: {
			x: 0,
			y: 0
		},
		scale: 1
	};
	fitted = this.view;
	fittedTo = "";
	frame = 0;
	moves = false;
	resting = 0;
	stroke = null;
	driveBegan = null;
	walls = null;
	constructor(app, theme) {
		this.app = app;
		this.theme = theme;
		new ResizeObserver(() => this.resize()).observe(this.parent);
		window.addEventListener("resize", () => this.resize());
	}
	get colours() {
		return palette(this.theme());
	}
	get lens() {
		return {
			view: this.view,
			size: this.size
		};
	}
	/** Brings panels, figures and pictures up to date with the next frame. */
	invalidate() {
		this.frame ||= requestAnimationFrame((now) => {
			this.frame = 0;
			this.render(now);
		});
	}
	zoom(steps) {
		const { width, height } = this.size;
		const centre = {
			x: width / 2,
			y: height / 2
		};
		this.setView(zoomed(this.view, this.size, centre, ZOOM_STEP ** steps, this.fitted));
	}
	fit() {
		this.setView(this.fitted);
	}
	get canDrive() {
		return this.app.planning.traces.some((trace) => trace.path.length > 1);
	}
	/** Drives along the paths, or stops. */
	drive() {
		this.driveBegan = this.driveBegan === null && this.canDrive ? performance.now() : null;
		this.onDrive(this.driveBegan !== null);
		this.invalidate();
	}
	setTool(tool) {
		this.tool = tool;
		for (const panel of this.panels) panel.view.dataset.tool = tool;
	}
	render(now) {
		const { problem, runs } = this.app.store.current;
		if (!problem) return;
		this.matchPanels(runs.length);
		this.fitMap();
		const { traces, bestPath } = this.app.planning;
		const { colours } = this;
		const drivers = this.drivers(now);
		this.panels.forEach((panel, index) => {
			const trace = traces[index];
			panel.update(runs[index], trace, colours);
			if (!trace) return;
			panel.draw({
				view: this.view,
				size: this.size,
				ratio: window.devicePixelRatio,
				moves: this.moves,
				colours,
				layers: this.layers,
				map: problem.map,
				obstacles: this.wallImage(colours),
				robot: problem.robot,
				start: problem.start,
				goal: problem.goal,
				best: bestPath,
				strokes: this.stroke ? [...this.app.strokes, this.stroke] : this.app.strokes
			}, trace, drivers[index] ?? null);
		});
		if (this.driveBegan !== null || traces.some((trace) => trace.tree.lags)) this.invalidate();
	}
	matchPanels(count) {
		if (this.panels.length === count) return;
		this.panels = Array.from({ length: count }, (_, index) => {
			return this.panels[index] ?? this.newPanel(index);
		});
		this.parent.replaceChildren(...this.panels.map((panel) => panel.element));
		this.parent.style.setProperty("--columns", String(Math.min(count, 2)));
		this.setTool(this.tool);
		this.resize();
	}
	newPanel(index) {
		const panel = new Panel(this.app, index, () => this.lens, () => this.invalidate());
		listenToGestures(panel.canvas, {
			dragStart: (at) => this.beginStroke(at),
			dragMove: (at, from) => this.dragTo(at, from),
			dragEnd: (_, cancelled) => this.endStroke(cancelled),
			click: (at) => this.click(at),
			pinch: (from, to, factor) => {
				const moved = panned(this.view, to.x - from.x, to.y - from.y);
				this.setView(zoomed(moved, this.size, to, factor, this.fitted));
			}
		});
		return panel;
	}
	world(at) {
		return toWorld(this.view, this.size, at);
	}
	beginStroke(at) {
		if (this.tool !== "wall" && this.tool !== "erase") return;
		const { x, y } = this.world(at);
		this.stroke = {
			points: [[x, y]],
			radius: this.brush,
			occupied: this.tool === "wall"
		};
		this.invalidate();
	}
	dragTo(at, from) {
		if (!this.stroke) {
			this.setView(panned(this.view, at.x - from.x, at.y - from.y));
			return;
		}
		const { x, y } = this.world(at);
		const [lastX, lastY] = this.stroke.points.at(-1);
		if (Math.hypot(x - lastX, y - lastY) > this.stroke.radius / 2) this.stroke.points.push([x, y]);
		this.invalidate();
	}
	endStroke(cancelled) {
		const { stroke } = this;
		this.stroke = null;
		if (stroke && !cancelled) this.app.draw(stroke);
		this.invalidate();
	}
	click(at) {
		const { tool } = this;
		const { problem } = this.app.store.current;
		if (!problem || tool !== "start" && tool !== "goal") return;
		const world = this.world(at);
		if (!this.app.contains(world)) return;
		this.app.moveEnd(tool, {
			...problem[tool],
			...world
		}, false);
		this.onToolUsed(tool);
	}
	setView(view) {
		this.view = view;
		this.moves = true;
		clearTimeout(this.resting);
		this.resting = window.setTimeout(() => {
			this.moves = false;
			this.invalidate();
		}, REST);
		this.invalidate();
	}
	resize() {
		const first = this.panels[0];
		if (!first) return;
		const { problem } = this.app.store.current;
		const width = first.view.clientWidth;
		const most = Math.max(260, window.innerHeight - 290) / (this.panels.length > 2 ? 1.35 : 1);
		const bounds = problem && mapBounds(problem.map);
		const aspect = bounds ? (bounds.top - bounds.bottom) / (bounds.right - bounds.left) : 1;
		const height = Math.round(Math.min(width * Math.min(Math.max(aspect, .4), 1.4), most));
		this.parent.style.setProperty("--view-height", `${height}px`);
		this.size = {
			width,
			height
		};
		this.invalidate();
	}
	/** Shows the whole map when it is a new one, and keeps the view where only cells changed. */
	fitMap() {
		const { problem } = this.app.store.current;
		if (!problem) return;
		const { width, height, origin } = problem.map;
		const extent = `${width} ${height} ${origin}`;
		if (`${extent} ${this.size.width} ${this.size.height}` === this.fittedTo) return;
		if (!this.fittedTo.startsWith(extent)) this.resize();
		this.fittedTo = `${extent} ${this.size.width} ${this.size.height}`;
		this.fitted = fit(mapBounds(problem.map), this.size, MARGIN);
		this.view = this.fitted;
	}
	wallImage(colours) {
		const { map } = this.app.store.current.problem;
		const key = `${map.id} ${colours.obstacle}`;
		if (this.walls?.key !== key) this.walls = {
			key,
			image: obstacles(map, this.app.raster, colours)
		};
		return this.walls.image;
	}
	/** Where the robots are: all drive at the same speed. */
	drivers(now) {
		if (this.driveBegan === null) return [];
		const walkers = this.app.planning.traces.map((trace) => trace.path.length > 1 ? new Walker(trace.path) : null);
		const longest = Math.max(0, ...walkers.map((walker) => walker?.length ?? 0));
		const share = Math.max(0, now - this.driveBegan) / (1e3 * DRIVE_SECONDS);
		if (share >= 1 || longest === 0) {
			this.driveBegan = null;
			this.onDrive(false);
		}
		return walkers.map((walker) => walker?.at(Math.min(share * longest, walker.length)) ?? null);
	}
};
// src/ui/theme.ts
var KEY = "planformer-theme";
var ThemeSwitch = class {
	chosen = stored();
	system = matchMedia("(prefers-color-scheme: dark)");
	constructor(changed) {
		const apply = () => {
			document.documentElement.dataset.theme = this.current;
			changed();
		};
		this.system.addEventListener("change", apply);
		byId("theme").addEventListener("click", () => {
			this.chosen = this.current === "dark" ? "light" : "dark";
			store(this.chosen);
			apply();
		});
		document.documentElement.dataset.theme = this.current;
	}
	get current() {
		return this.chosen ?? (this.system.matches ? "dark" : "light");
	}
};
function stored() {
	try {
		const value = localStorage.getItem(KEY);
		return value === "light" || value === "dark" ? value : null;
	} catch {
		return null;
	}
}
function store(theme) {
	try {
		localStorage.setItem(KEY, theme);
	} catch {}
}
// src/ui/toolbar.ts
var HINTS = {
	start: "Click or tap where the robot starts.",
	goal: "Click or tap where it should go."
};
var Toolbar = class {
	app;
	stage;
	brush = byId("brush");
	driveButton = byId("drive");
	constructor(app, stage) {
		this.app = app;
		this.stage = stage;
		for (const radio of radios()) radio.addEventListener("change", () => this.choose(radio.value));
		this.brush.addEventListener("input", () => this.setBrush());
		byId("undo").addEventListener("click", () => app.undo());
		byId("zoom-in").addEventListener("click", () => stage.zoom(1));
		byId("zoom-out").addEventListener("click", () => stage.zoom(-1));
		byId("zoom-fit").addEventListener("click", () => stage.fit());
		this.driveButton.addEventListener("click", () => stage.drive());
		stage.onDrive = (drives) => setText(this.driveButton, drives ? "■ Stop" : "▶ Drive");
		stage.onToolUsed = (tool) => this.choose(tool === "start" ? "goal" : "move");
		this.setBrush();
	}
	choose(tool) {
		for (const radio of radios()) radio.checked = radio.value === tool;
		this.stage.setTool(tool);
		byId("brush-field").hidden = tool !== "wall" && tool !== "erase";
		const hint = HINTS[tool];
		byId("hint").hidden = hint === void 0;
		setText(byId("hint"), hint ?? "");
	}
	update() {
		byId("undo").disabled = !this.app.canUndo;
		this.driveButton.disabled = !this.stage.canDrive;
		byId("add-run").hidden = !this.app.canAddRun;
	}
	setBrush() {
		this.stage.brush = Number(this.brush.value);
		setText(byId("brush-value"), metres(2 * this.stage.brush));
	}
};
function radios() {
	return document.querySelectorAll("[name=tool]");
}
// src/main.ts
/** Puts the page together. */
async function main() {
	let changed = () => {};
	const theme = new ThemeSwitch(() => changed());
	const client = new Client(document.baseURI);
	const app = new App(client, await client.options(), () => changed());
	const stage = new Stage(app, () => theme.current);
	const toolbar = new Toolbar(app, stage);
	const alert = new Alert(app);
	const exports = new Exports(app, stage);
	const upload = async (files) => {
		const before = app.store.current.problem?.map;
		await app.upload(files, controls.resolution);
		if (app.store.current.problem?.map === before) return;
		toolbar.choose("start");
		await controls.refreshMaps();
	};
	const controls = new Controls(app, stage, upload);
	changed = () => {
		stage.invalidate();
		toolbar.update();
		controls.update();
		alert.update();
		showFacts(app);
		showChart(app, stage);
	};
	listenToDrops(upload);
	listenToKeys({
		app,
		stage,
		toolbar,
		exports
	});
	keepAddress(app);
	await app.begin(location.hash);
	await controls.refreshMaps();
}
function showFacts(app) {
	const { problem } = app.store.current;
	if (!problem) return;
	const { name, width, height, columns, rows } = problem.map;
	const size = `${width.toFixed(1)} × ${height.toFixed(1)} m`;
	setText(byId("facts"), `${name} · ${size} · ${columns} × ${rows} cells`);
}
function showChart(app, stage) {
	const { runs, live } = app.store.current;
	if (live) return;
	const drawing = chart(runs, app.planning.traces.slice(0, runs.length), stage.colours);
	byId("chart").hidden = drawing === null;
	byId("chart-body").replaceChildren(...drawing ? [drawing] : []);
}
/** The address bar holds a link to what is shown, and a link that is put there is shown. */
function keepAddress(app) {
	let written = "";
	app.store.subscribe(({ live }) => {
		if (live || app.link === written) return;
		written = app.link;
		history.replaceState(null, "", written);
	});
	window.addEventListener("hashchange", () => {
		if (location.hash !== written) app.begin(location.hash);
	});
}
main().catch((error) => {
	byId("alert").hidden = false;
	byId("alert-text").textContent = error instanceof ApiError ? error.message : `The page failed: ${String(error)}`;
	throw error;
});
