/** Angles are those of the pinion, rad, of any size to 1e12; what does not exist is NaN. */
export interface Contact {
  /** Number of the tooth pair whose reference angle is the nearest. */
  pair: number;
  /** Its own angle: the angle less so many pitches. */
  angle: number;
  /** Its transmission error, rad. */
  error: number;
  /** How the solve ended: "converged", "line_contact", or why there is no contact. */
  status: string;
}

/** One flank of the drive. */
export interface Side {
  /** The pair that leads. */
  pair: number;
  /** Transmission error in the angles of the driving flank, rad. */
  error: number;
  /** d(wheel angle)/d(pinion angle). */
  ratio: number;
  status: string;
  /** Pairs that touch within their limits; 0 along lines. */
  pairs: number;
  /** Whether the edge of another pair may touch first. */
  edge: boolean;
}

export interface Cycle {
  pair: number;
  angle: number;
  /** How far the wheel is free between both flanks, rad; negative where the drive jams. */
  backlash: number;
  drive: Side;
  coast: Side;
}

export interface Mesh {
  follow(phi: number): Contact;
  cycle(phi: number): Cycle;
}

/** The drive, ready; several may be loaded, each with its own memory. */
export function load(): Promise<Mesh>;
