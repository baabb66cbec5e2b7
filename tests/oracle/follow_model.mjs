// A model in MuJoCo itself (npm @mujoco/mujoco): its motor is sent home → top → bottom → top → bottom, and the
// angles of both hinges on the way are printed. node follow_model.mjs <mujoco.js> <model.xml>
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const [library, file] = process.argv.slice(2);
const mujoco = await (await import(pathToFileURL(library).href)).default();
mujoco.FS.writeFile('/model.xml', readFileSync(file));
const model = mujoco.MjModel.mj_loadXML('/model.xml');
const data = new mujoco.MjData(model);
const [low, high] = model.actuator_ctrlrange;
const k_stroke_seconds = 3;
const steps = Math.round(k_stroke_seconds / model.opt.timestep);
const rows = [];
let command = 0;
for (const end of [high, low, high, low]) {
  const from = command;
  for (let i = 1; i <= steps; ++i) {
    command = from + (end - from) * Math.min(1, (1.1 * i) / steps);  // the last tenth of the time is a dwell
    data.ctrl[0] = command;
    mujoco.mj_step(model, data);
    if (i % 10 === 0) {
      mujoco.mj_forward(model, data);  // updates lengths and positions to this time
      rows.push([data.time, command, data.qpos[0], data.qpos[1], ...(data.ten_length ?? [])]);
    }
  }
}
console.log(JSON.stringify({ version: mujoco.mj_versionString?.() ?? '', range: [low, high], rows }));
