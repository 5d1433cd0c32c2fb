/**
 * Gives the server the token of an invitation (`#token=smb_...`; what follows a `#` is not sent by itself), which it keeps
 * as a cookie that scripts cannot read. A token that is refused changes nothing: the face says that the stream is private.
 */
export async function acceptInvitation(base: string): Promise<void> {
  const token = new URLSearchParams(location.hash.slice(1)).get('token');
  if (token === null) return;
  // The address must not keep the token: it is seen on the screen, and stays in the browser's history.
  history.replaceState(null, '', location.pathname + location.search);
  await fetch(`${base}/v1/session`, {
    method: 'POST',
    headers: { 'Content-Type': 'application/json' },
    body: JSON.stringify({ token }),
  }).catch(() => undefined);
}
