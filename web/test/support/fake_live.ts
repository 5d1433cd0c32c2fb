import { LiveModel } from '../../src/ui/live/live_model.ts';

/** LiveModel as it is, but for the socket. */
export class FakeLive extends LiveModel {
  override subscribe(id: string): void {
    this.following.set(id);
    this.status.set({ kind: 'open' });
    this.driver.byStream();
  }
}
