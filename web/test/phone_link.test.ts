import { expect, test } from 'vitest';
import { isLoopback, phoneLink } from '../src/net/phone_link.ts';

test('PhoneLink_NamesTheStream_AndCarriesTheTokenWhereNoServerSeesIt', () => {
  expect(phoneLink('https://10.0.0.7:8443', 'demo')).toBe('https://10.0.0.7:8443/view/demo');
  expect(phoneLink('https://a.example/faces', 'a b/c', 'smb_x')).toBe('https://a.example/faces/view/a%20b%2Fc#token=smb_x');
});

test('Loopback_IsNoAddressForAPhone', () => {
  for (const host of ['localhost', 'studio.localhost', '127.0.0.1', '127.1.2.3', '[::1]', 'LOCALHOST']) expect(isLoopback(host), host).toBe(true);
  for (const host of ['192.168.0.7', '[fe80::1]', 'localhost.example', 'face.example', '128.0.0.1']) expect(isLoopback(host), host).toBe(false);
});
