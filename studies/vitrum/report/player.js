"use strict";
(() => {
  const run = JSON.parse(document.getElementById("player").textContent);
  const bytes = text => Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  const places = new Uint16Array(bytes(run.places).buffer), body = bytes(run.body);
  for (const field of run.fields) field.codes = bytes(field.data);
  const find = id => document.getElementById(id);
  const canvas = find("stage"), pen = canvas.getContext("2d"), slider = find("frame"), play = find("play");
  const dark = matchMedia("(prefers-color-scheme: dark)");
  // magma, nine stops: on dark paper the most is bright, on light paper dark.
  const magma = [[0, 0, 4], [28, 16, 68], [79, 18, 123], [129, 37, 129], [181, 54, 122], [229, 80, 100], [251, 135, 97], [254, 194, 135], [252, 253, 191]];
  const shade = share => {
    const at = (dark.matches ? 0.08 + 0.92 * share : 0.96 - 0.86 * share) * 8, low = Math.min(7, Math.floor(at));
    return "rgb(" + magma[low].map((value, n) => Math.round(value + (at - low) * (magma[low + 1][n] - value))).join(",") + ")";
  };
  const faint = () => dark.matches ? "#39424a" : "#e3eaef";
  const colourOf = (field, code, of) => {
    if (code === 255) return faint();
    if (field.kind !== "class") return shade(code / 254);
    if (field.key === "bodies") return run.looks[of][code];
    return code === 0 ? run.looks[of][0] : code === 7 ? "#6e6e6e" : run.pieces[code - 1];
  };
  let frame = 0, field = run.fields[0], view = [...run.views[0]], timer = null;

  function draw() {
    const width = canvas.clientWidth, height = canvas.clientHeight, ratio = devicePixelRatio || 1;
    canvas.width = width * ratio; canvas.height = height * ratio;
    pen.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--card");
    pen.fillRect(0, 0, canvas.width, canvas.height);
    const scale = Math.min(width / (view[1] - view[0]), height / (view[3] - view[2])) * ratio;
    const middle = [0.5 * (view[0] + view[1]), 0.5 * (view[2] + view[3])];
    const batches = new Map();
    for (let n = 0; n < run.count; ++n) {
      const code = field.codes[frame * run.count + n], key = field.kind === "class" || code === 255 ? 256 * body[n] + code : code;
      if (!batches.has(key)) batches.set(key, []);
      batches.get(key).push(n);
    }
    for (const [key, members] of batches) {
      const of = body[members[0]];
      pen.fillStyle = colourOf(field, field.codes[frame * run.count + members[0]], of);
      for (const n of members) {
        const at = 2 * (frame * run.count + n), side = Math.max(1, (run.side.length ? run.side[n] : run.side) * scale);
        const x = run.low[0] + places[at] / 65535 * run.size[0], y = run.low[1] + places[at + 1] / 65535 * run.size[1];
        const top = canvas.height / 2 - (y - middle[1]) * scale - side / 2;
        pen.fillRect(canvas.width / 2 + (x - middle[0]) * scale - side / 2, top, side + 0.5, side + 0.5);
        if (run.mirror) pen.fillRect(canvas.width / 2 + (-x - middle[0]) * scale - side / 2, top, side + 0.5, side + 0.5);
      }
    }
    find("time").textContent = (1e6 * run.times[frame]).toPrecision(4).replace("-", "\u2212") + " µs";
    canvas.dataset.frame = frame;
  }

  function legend() {
    document.querySelector(".scale").hidden = field.kind === "class";
    const keys = document.querySelector(".keys");
    keys.replaceChildren();
    const add = (colour, text) => {
      const entry = document.createElement("span"), box = document.createElement("i");
      box.style.background = colour; entry.append(box, text); keys.append(entry);
    };
    if (field.kind !== "class") {
      find("low").textContent = field.low ? field.low.toPrecision(2) : "0"; find("high").textContent = field.high.toPrecision(3) + " " + field.label;
      find("bar").style.background = "linear-gradient(to right," + Array.from({length: 9}, (_, n) => shade(n / 8)).join() + ")";
    } else if (field.key === "bodies") run.bodies.forEach((name, of) => { add(run.looks[of][0], name); if (separates(of)) add(run.looks[of][1], name + ", separated"); });
    else { run.bodies.forEach((name, of) => add(run.looks[of][0], name + ", largest piece")); add(run.pieces[0], "other pieces"); add("#6e6e6e", "separated"); }
  }
  const separates = of => field.codes.some((code, n) => code === 1 && body[n % run.count] === of);

  function show(next) { frame = Math.max(0, Math.min(run.times.length - 1, next)); slider.value = frame; remember(); draw(); }
  function remember() { try { sessionStorage.setItem("vitrum", JSON.stringify([frame === run.times.length - 1 ? -1 : frame, field.key])); } catch (_) { /* no storage: nothing to go on from */ } }
  function choose(chosen) {
    field = chosen;
    document.querySelectorAll(".fields button[data-key]").forEach(button => button.setAttribute("aria-pressed", button.dataset.key === field.key));
    legend(); remember(); draw();
  }
  function pause() { clearInterval(timer); timer = null; play.textContent = "▶"; play.setAttribute("aria-label", "play"); }
  play.onclick = () => {
    if (timer) return pause();
    if (frame === run.times.length - 1) show(0);
    timer = setInterval(() => { if (frame === run.times.length - 1) pause(); else show(frame + 1); }, 120);
    play.textContent = "❚❚"; play.setAttribute("aria-label", "pause");
  };
  slider.max = run.times.length - 1;
  slider.oninput = () => { pause(); show(Number(slider.value)); };

  const buttons = document.querySelector(".fields");
  for (const each of run.fields) {
    const button = document.createElement("button");
    button.textContent = each.label; button.dataset.key = each.key; button.onclick = () => choose(each);
    buttons.append(button);
  }
  if (run.views.length > 1) {
    const button = document.createElement("button");
    let close = true;
    button.textContent = "whole"; button.id = "whole";
    button.onclick = () => { close = !close; view = [...run.views[close ? 0 : 1]]; button.textContent = close ? "whole" : "close-up"; draw(); };
    buttons.append(button);
  }

  const scaleNow = () => Math.min(canvas.clientWidth / (view[1] - view[0]), canvas.clientHeight / (view[3] - view[2]));
  function zoom(factor, x, y) {
    const box = canvas.getBoundingClientRect(), scale = scaleNow();
    const at = [0.5 * (view[0] + view[1]) + (x - box.left - box.width / 2) / scale, 0.5 * (view[2] + view[3]) - (y - box.top - box.height / 2) / scale];
    view = view.map((limit, n) => at[n >> 1] + (limit - at[n >> 1]) / factor);
    draw();
  }
  canvas.onwheel = event => { event.preventDefault(); zoom(Math.exp(-0.002 * event.deltaY), event.clientX, event.clientY); };
  canvas.ondblclick = () => { view = [...run.views[0]]; draw(); };
  const fingers = new Map();
  canvas.onpointerdown = event => { canvas.setPointerCapture(event.pointerId); fingers.set(event.pointerId, [event.clientX, event.clientY]); };
  canvas.onpointerup = canvas.onpointercancel = event => fingers.delete(event.pointerId);
  canvas.onpointermove = event => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const now = [event.clientX, event.clientY], others = [...fingers].filter(([id]) => id !== event.pointerId);
    fingers.set(event.pointerId, now);
    if (others.length) {
      const [x, y] = others[0][1], reach = point => Math.hypot(point[0] - x, point[1] - y);
      return zoom(reach(now) / Math.max(1, reach(before)), 0.5 * (now[0] + x), 0.5 * (now[1] + y));
    }
    const scale = scaleNow();
    view = [view[0] - (now[0] - before[0]) / scale, view[1] - (now[0] - before[0]) / scale, view[2] + (now[1] - before[1]) / scale, view[3] + (now[1] - before[1]) / scale];
    draw();
  };

  function shape() {
    const first = run.views[0], share = (first[3] - first[2]) / (first[1] - first[0]);
    canvas.style.height = Math.round(Math.min(0.7 * innerHeight, Math.max(160, canvas.clientWidth * share))) + "px";
    draw();
  }
  addEventListener("resize", shape);
  dark.addEventListener("change", () => { legend(); draw(); });
  let kept = null;
  try { kept = JSON.parse(sessionStorage.getItem("vitrum")); } catch (_) { /* none */ }
  frame = kept && kept[0] >= 0 ? Math.min(kept[0], run.times.length - 1) : run.times.length - 1;
  slider.value = frame;
  shape();
  choose(run.fields.find(each => kept && each.key === kept[1]) || run.fields[0]);
})();
