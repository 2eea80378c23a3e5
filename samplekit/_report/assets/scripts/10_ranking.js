// Which sampler reaches a target error first, for every cost of a sample, as far as the intervals tell.

// Where a curve first reaches the target, on straight lines between its points in log-log; null where it does not.
function reached(points, target) {
  for (const [index, { samples, error }] of points.entries()) {
    if (!(error <= target)) continue;
    const before = points[index - 1];
    if (!before || !Number.isFinite(before.error)) return samples;
    const share = error > 0 ? Math.log(before.error / target) / Math.log(before.error / error) : 0;
    return before.samples * (samples / before.samples) ** share;
  }
  return null;
}

// Own seconds of so many samples, on straight lines in log-log between the rows and level beyond them.
function secondsAt(rows, samples) {
  const scale = d3.scaleLog(
    rows.map((row) => row.samples),
    rows.map((row) => measured(row).estimate),
  );
  if (rows.length === 1) return measured(rows[0]).estimate;
  return scale.interpolate((a, b) => (t) => a * (b / a) ** t).clamp(true)(samples);
}

// What a sampler needs: least and most samples and own seconds. The least is 0 where nothing bounds it from below, the
// most is infinite where nothing bounds it from above.
function needed(rows, target) {
  const curve = (errorOf) => rows.map((row) => ({ samples: row.samples, error: errorOf(row.mse) }));
  const low = reached(curve(({ low }) => low ?? 0), target);
  const high = reached(curve(({ high }) => high ?? Infinity), target);
  const shares = rows.map((row) => measured(row)).map(({ estimate, low, high }) => [low / estimate, high && high / estimate]);
  const least = low === null ? rows.at(-1).samples : low > rows[0].samples ? low : 0;
  const most = high ?? Infinity;
  const known = shares.every(([, share]) => share);
  return {
    least: { samples: least, seconds: least && secondsAt(rows, least) * d3.min(shares, ([share]) => share) },
    most: { samples: most, seconds: known && high ? secondsAt(rows, high) * d3.max(shares, ([, share]) => share) : Infinity },
  };
}

// Those of the needs whose least total time no other certainly beats; none where nothing bounds a time from above.
function fastest(needs, cost) {
  const total = ({ samples, seconds }) => seconds + cost * samples;
  const bound = d3.min(needs, ({ most }) => total(most));
  return Number.isFinite(bound) ? needs.filter(({ least }) => total(least) <= bound) : [];
}

// Ranges of costs in seconds, ascending, with the names of those that may be the fastest in each.
function winners(needs, costs) {
  const found = [];
  for (const cost of costs) {
    const names = fastest(needs, cost).map(({ name }) => name);
    if (names.length && found.at(-1)?.names.join() !== names.join()) found.push({ names, from: cost });
  }
  return found;
}
