% Transmission error, rad, at pinion angles, rad, of any size, in Octave or MATLAB, from the samples of one pitch:
%   meshwright export DESIGN --table te.csv
function error = error_over_angle(file, angles)
  samples = dlmread(file, ',', 1, 0);
  pitch = samples(end, 1);
  error = interp1(samples(:, 1), samples(:, 2), angles - pitch * floor(angles / pitch), 'spline');
end
