/** The state of the page, and who wants to know of its changes. */

import type { Limits, Problem, Run } from "../model/problem";

export interface State {
  /** Null until the first map is there. */
  problem: Problem | null;
  /** One to four. */
  runs: Run[];
  limits: Limits;
  /** Whether something is being dragged: plans are then short, and many. */
  live: boolean;
}

type Listener = (next: State, former: State) => void;

export class Store {
  private readonly listeners: Listener[] = [];

  constructor(private state: State) {}

  get current(): State {
    return this.state;
  }

  update(change: Partial<State>): void {
    const former = this.state;
    this.state = { ...former, ...change };
    for (const listener of this.listeners) listener(this.state, former);
  }

  subscribe(listener: Listener): void {
    this.listeners.push(listener);
  }
}
