// Lays the strand before one's eyes: time goes on, faster than a machine by a factor.

// Factors of the speed slider's ends; between them it is geometric.
const SLOWEST = 1, FASTEST = 2000;

class Player {
  constructor(plan) {
    this.plan = plan;
    this.factor = 1;
    this.playing = false;
  }

  set slider(value) {
    const factor = SLOWEST * (FASTEST / SLOWEST) ** (value / 100);
    this.factor = Number(factor.toPrecision(factor < 100 ? 1 : 2));
  }

  // The place after some seconds; at the strand's end it stops.
  next(place, seconds) {
    const { plan } = this;
    const time = plan.amountAt(plan.time, place) + seconds * this.factor;
    if (time >= plan.time[plan.moves]) {
      this.playing = false;
      return plan.moves;
    }
    return plan.placeOf(plan.time, time);
  }
}

function duration(seconds) {
  const whole = Math.round(seconds);
  const [h, m, s] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  if (h > 0) return `${h} h ${m} min`;
  return m > 0 ? `${m} min ${s} s` : `${s} s`;
}
