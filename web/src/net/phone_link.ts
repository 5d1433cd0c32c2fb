/** The address of the page that shows one stream and nothing else, made for phones. A token travels behind the `#`. */
export function phoneLink(base: string, stream: string, token?: string): string {
  const invitation = token === undefined ? '' : `#token=${token}`;
  return `${base}/view/${encodeURIComponent(stream)}${invitation}`;
}

/** Whether a host name is that of this machine itself, which no other device can reach. */
export function isLoopback(hostname: string): boolean {
  return /^(localhost|.*\.localhost|127(\.\d+){3}|\[::1\])$/i.test(hostname);
}
