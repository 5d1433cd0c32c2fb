import { pointById } from '../../face/feature_points.ts';
import type { LiveModel } from '../live/live_model.ts';
import type { PointsModel } from '../points/points_model.ts';
import type { Studio } from '../shared/studio.ts';
import { isNarrow, tabTitle } from './layout.ts';
import { formatRoute, isStep, parseRoute, type Route } from './route.ts';
import { t } from '../../words/words.ts';

/** Keeps the page's address and its contents equal: a change of the page is a step that Back takes back. */
export class Address {
  /** The route that the address shows. */
  private route = parseRoute(location.hash);
  private waiting = false;
  private started = false;

  constructor(
    private readonly studio: Studio,
    private readonly points: PointsModel,
    private readonly live: LiveModel,
  ) {}

  /** Opens what the address names, else what a new visitor sees first. Call it once the heads and streams are known. */
  start(): void {
    const { studio, live, route } = this;
    const { value: heads } = studio.models;
    const wanted = heads.find((head) => head.id === route.head);
    const first =
      wanted ??
      heads.find((head) => head.id === 'sample') ??
      heads.find((head) => head.state === 'parametrized') ??
      heads[0];
    if (route.head !== null && !wanted && studio.shelf.value.kind === 'ready')
      studio.toasts.say(t('The head of this address is not on the server.'));
    if (first) studio.select(first.id);
    if (wanted) this.enter(route);
    if (live.following.value === null && studio.selected.value?.state === 'parametrized' && live.demo)
      live.subscribe(live.demo.id, live.demo.title);
    this.started = true;
    studio.selected.watch(() => this.changed());
    studio.tab.watch(() => this.changed());
    this.points.chosen.watch(() => this.changed());
    live.following.watch(() => this.changed());
    window.addEventListener('popstate', () => void this.follow());
  }

  /** Back, Forward, or an address that was typed. What it names may have come to the server since the lists were read. */
  private async follow(): Promise<void> {
    const route = parseRoute(location.hash);
    const { studio, live } = this;
    this.route = route;
    const has = (list: readonly { id: string }[] | null, id: string | null): boolean => id === null || (list ?? []).some((one) => one.id === id);
    if (!has(studio.models.value, route.head)) await studio.update();
    if (!has(live.streams.value, route.stream)) await live.refresh();
    if (this.route !== route) return; // another address has come meanwhile
    if (route.head !== null && route.head !== studio.selected.value?.id) {
      if (has(studio.models.value, route.head)) studio.select(route.head);
      else studio.toasts.say(t('The head of this address is not on the server.'));
    }
    if (route.stream === null && this.namedStream() !== null) live.unsubscribe();
    this.enter(route);
  }

  /** Tab, point and stream of a route. */
  private enter({ tab, point, stream }: Route): void {
    const { studio, live, points } = this;
    if (tab !== null && (tab !== 'heads' || isNarrow().matches)) studio.tab.set(tab);
    points.chosen.set(point !== null && pointById(point) ? point : null);
    if (stream === null || stream === live.following.value) return;
    if (live.streams.value?.some(({ id }) => id === stream)) live.subscribe(stream, live.titleOf(stream));
    else studio.toasts.say(t('The stream of this address has ended.'));
  }

  /** The followed stream, unless it is the demo, which every visitor follows anyway. */
  private namedStream(): string | null {
    const id = this.live.following.value;
    return id === this.live.demo?.id ? null : id;
  }

  /** Several signals change together (a head and its tab): one step of the history for all of them. */
  private changed(): void {
    if (!this.started || this.waiting) return;
    this.waiting = true;
    queueMicrotask(() => {
      this.waiting = false;
      this.write();
    });
  }

  private write(): void {
    const { studio, points } = this;
    const tab = studio.tab.value;
    const to: Route = {
      head: studio.selected.value?.id ?? null,
      tab,
      point: tab === 'points' ? points.chosen.value : null,
      stream: this.namedStream(),
    };
    const address = formatRoute(to);
    document.title = [studio.selected.value?.name, tabTitle(tab), 'Semblante'].filter(Boolean).join(' · ');
    if (address === formatRoute(this.route)) return;
    // The first address is completed, not left.
    const step = this.route.tab !== null && isStep(this.route, to);
    if (step) history.pushState(null, '', address);
    else history.replaceState(null, '', address);
    this.route = to;
  }
}
