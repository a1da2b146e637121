'use strict';
// How numbers and units are written for people.
const Numbers = (() => {
  const superscripts = '⁰¹²³⁴⁵⁶⁷⁸⁹';

  function powerOfTen(exponent) {
    const digits = String(Math.abs(exponent)).replace(/\d/g, (d) => superscripts[d]);
    return `10${exponent < 0 ? '⁻' : ''}${digits}`;
  }

  const withMinus = (text) => text.replace('-', '−');
  const isNumber = (value) => typeof value === 'number' && Number.isFinite(value);

  // `digits` significant digits, trailing zeros kept so that columns line up.
  function format(value, digits = 4) {
    if (!isNumber(value)) return '–';
    if (value === 0) return '0';
    const magnitude = Math.floor(Math.log10(Math.abs(value)));
    if (magnitude >= -3 && magnitude < 6) {
      return withMinus(value.toFixed(Math.max(0, digits - 1 - magnitude)));
    }
    const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
    return withMinus(`${mantissa}×${powerOfTen(Number(exponent))}`);
  }

  // As short as the value allows, for ticks and sentences.
  function short(value, digits = 4) {
    if (!isNumber(value)) return '–';
    if (value === 0) return '0';
    const magnitude = Math.floor(Math.log10(Math.abs(value)));
    if (magnitude >= -3 && magnitude < 5) {
      return withMinus(String(Number(value.toPrecision(digits))));
    }
    const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
    const power = powerOfTen(Number(exponent));
    const shortest = String(Number(mantissa));
    if (shortest === '1') return power;
    if (shortest === '-1') return `−${power}`;
    return withMinus(`${shortest}×${power}`);
  }

  // A fraction as a percentage.
  function percent(fraction, digits = 3) {
    return isNumber(fraction) ? `${format(100 * fraction, digits)} %` : '–';
  }

  function duration(seconds) {
    if (!isNumber(seconds)) return '–';
    if (seconds < 1e-3) return `${format(1e6 * seconds, 3)} µs`;
    if (seconds < 1) return `${format(1e3 * seconds, 3)} ms`;
    if (seconds < 600) return `${format(seconds, 3)} s`;
    return `${format(seconds / 60, 3)} min`;
  }

  const degrees = (radians) => `${format(radians * 180 / Math.PI, 4)}°`;

  // What cycles per time unit are called.
  const cycles = (timeUnit) => (timeUnit === 's' ? 'Hz' : `1/${timeUnit}`);

  return {
    format, short, percent, duration, degrees, cycles, powerOfTen, isNumber,
  };
})();
