import { requestJson } from './http.ts';
import type { Session } from './types.ts';

const address = '/v1/session';

/** What this browser may do on the server. */
export async function getSession(base: string): Promise<Session> {
  return (await requestJson<Session>(base + address)).value;
}

/** Gives the server a token, which it returns as a cookie that scripts cannot read. Throws ApiError. */
export async function signIn(base: string, token: string): Promise<Session> {
  return (await requestJson<Session>(base + address, { method: 'POST', json: { token } })).value;
}

export async function signOut(base: string): Promise<void> {
  await requestJson<void>(base + address, { method: 'DELETE' });
}

/** The token in an invitation such as `#token=smb_...`, or null. What follows a `#` is not sent to a server. */
export function invitedToken(hash: string): string | null {
  return new URLSearchParams(hash.replace(/^#/, '')).get('token');
}
