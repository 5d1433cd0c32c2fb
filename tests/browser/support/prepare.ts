import { rmSync } from 'node:fs';
import { prepareData, preparedData } from './server.ts';

/** Before all test files: the sample head is parametrized once. Gives what is done after them. */
export default async function prepare(): Promise<() => void> {
  const folder = (process.env[preparedData] = await prepareData());
  return () => rmSync(folder, { recursive: true, force: true });
}
