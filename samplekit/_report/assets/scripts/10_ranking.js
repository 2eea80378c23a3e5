// Which sampler reaches a target error first, for every cost of a sample.

// Samples and own time at which a curve first reaches the target, on straight lines between counts in log-log;
// null where it does not within its counts.
function reaching(points, target) {
  const known = points.filter((point) => point.error !== null && point.seconds > 0);
  for (let index = 0; index < known.length; index += 1) {
    const point = known[index];
    if (point.error > target) continue;
    const before = known[index - 1];
    if (!before || point.error === 0) return { samples: point.count, seconds: point.seconds, first: !before };
    const share = Math.log(before.error / target) / Math.log(before.error / point.error);
    const between = (a, b) => Math.exp(Math.log(a) + share * Math.log(b / a));
    return {
      samples: between(before.count, point.count),
      seconds: between(before.seconds, point.seconds),
      first: false,
    };
  }
  return null;
}

// Total time is a straight line in the cost: own seconds + samples * cost. The winners are its lower envelope.
// Returns [{index, from}] with costs in seconds, ascending from 0.
function winners(lines) {
  const found = [];
  let cost = 0;
  let best = d3.least(lines, (a, b) => a.seconds - b.seconds || a.samples - b.samples);
  while (best) {
    found.push({ index: best.index, from: cost });
    const current = best;
    const crossings = lines
      .filter((line) => line.samples < current.samples)
      .map((line) => ({ line, at: (line.seconds - current.seconds) / (current.samples - line.samples) }));
    const next = d3.least(crossings, (a, b) => a.at - b.at || a.line.samples - b.line.samples);
    cost = next ? Math.max(cost, next.at) : cost;
    best = next?.line;
  }
  return found;
}
