import type { Api } from './api.ts';
import { ApiError } from './problem.ts';
import type { Job, JobState } from './types.ts';

const finalStates: readonly JobState[] = ['done', 'failed', 'cancelled'];
export const isFinal = (job: Job): boolean => finalStates.includes(job.state);

/**
 * Follows a job to its end through its Server-Sent Events, and by polling when they break off (a proxy may buffer
 * them). Resolves with the job in its final state; rejects only if the job cannot be read at all.
 */
export async function followJob(api: Api, job: Job, onUpdate: (job: Job) => void, signal?: AbortSignal): Promise<Job> {
  onUpdate(job);
  if (isFinal(job)) return job;
  const last = await listen(api, job, onUpdate, signal);
  if (isFinal(last)) return last;
  return poll(api, last, onUpdate, signal);
}

function listen(api: Api, first: Job, onUpdate: (job: Job) => void, signal?: AbortSignal): Promise<Job> {
  if (typeof EventSource === 'undefined') return Promise.resolve(first);
  return new Promise((resolve, reject) => {
    let latest = first;
    const source = new EventSource(api.jobEventsUrl(first.id));
    const close = (): void => source.close();
    const take = (event: MessageEvent<string>): void => {
      let value: Job;
      try {
        value = JSON.parse(event.data) as Job;
      } catch {
        return;
      }
      latest = value;
      onUpdate(latest);
      if (isFinal(latest)) {
        close();
        resolve(latest);
      }
    };
    for (const name of ['progress', ...finalStates]) source.addEventListener(name, take);
    source.onerror = () => {
      close();
      resolve(latest);
    };
    signal?.addEventListener('abort', () => {
      close();
      reject(new DOMException('No longer followed', 'AbortError'));
    });
  });
}

async function poll(api: Api, job: Job, onUpdate: (job: Job) => void, signal?: AbortSignal): Promise<Job> {
  let failures = 0;
  for (;;) {
    if (signal?.aborted) throw new DOMException('No longer followed', 'AbortError');
    try {
      const latest = await api.getJob(job.id);
      failures = 0;
      onUpdate(latest);
      if (isFinal(latest)) return latest;
    } catch (error) {
      failures += 1;
      if (failures > 4 || (error instanceof ApiError && error.problem.status === 404)) throw error;
    }
    await new Promise((wake) => setTimeout(wake, 500 * (failures + 1)));
  }
}
