import { chromium } from 'playwright-core';
const url = process.argv[2], out = process.argv[3];
const b = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-sync', '--disable-component-update'] });
for (const [name, w, h] of [['wide', 1440, 900], ['phone', 390, 844]]) for (const scheme of ['light', 'dark']) {
  const c = await b.newContext({ viewport: { width: w, height: h }, colorScheme: scheme });
  const p = await c.newPage();
  p.on('console', m => { if (m.type() === 'error') console.log(name, scheme, 'console', m.text()); });
  p.on('pageerror', e => console.log('pageerror', e.message));
  const t = Date.now();
  await p.goto(url); await p.waitForTimeout(6000);
  await p.screenshot({ path: `${out}/${name}-${scheme}.png` });
  if (name === 'wide' && scheme === 'light') console.log(await p.evaluate(() => document.body.innerText.slice(0, 1500)));
  await c.close();
}
await b.close();
