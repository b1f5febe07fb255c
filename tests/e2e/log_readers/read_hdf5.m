% Reads an HDF5 export with Octave's own loader and compares every value with the CSV export of the same log.
%
%   octave-cli --norc read_hdf5.m FILE CSV_FOLDER
%
% Octave turns what cannot stand in a name into _: header.sim_time_ns becomes header_sim_time_ns, the group 0 _0.

1;

function names = column_names(path)
  file = fopen(path);
  names = strsplit(fgetl(file), ",");
  fclose(file);
end

% The cells of a CSV file below its first line, one cell array of strings for each column.
function cells = read_cells(path, count)
  file = fopen(path);
  cells = textscan(file, repmat("%q", 1, count), "Delimiter", ",", "HeaderLines", 1, "EndOfLine", "\n", ...
                   "Whitespace", "");
  fclose(file);
end

% Exact up to 64 bits: the last nine digits and those before them, joined in integer arithmetic.
function numbers = to_integers(texts, type)
  characters = strjust(char(texts), "right");
  sign = 1 - 2 * any(characters == "-", 2);
  characters(! isdigit(characters)) = "0";
  digits = [zeros(rows(characters), 20 - columns(characters)), characters - "0"];
  high = digits(:, 1:11) * 10 .^ (10:-1:0)';
  low = digits(:, 12:20) * 10 .^ (8:-1:0)';
  numbers = cast(sign .* high, type) * cast(1e9, type) + cast(sign .* low, type);
end

function same = same_doubles(values, texts)
  expected = sscanf(strjoin(texts(:)', " "), "%f");
  bits = @(x) typecast(x(:), "uint64");
  same = (bits(values) == bits(expected)) | (isnan(values(:)) & isnan(expected));
end

function same = agrees(values, texts)
  if isa(values, "double")
    same = same_doubles(values, texts);
  elseif ischar(values)
    same = strcmp(without_padding(values), regexprep(texts, " +$", ""));
  else
    same = values(:) == to_integers(texts, class(values));
  end
end

% Rows of characters padded with NUL, as strings; blanks at the end are lost.
function texts = without_padding(characters)
  characters(characters == char(0)) = " ";
  texts = cellstr(characters);
end

function values = check_topic(group, folder, topic)
  path = fullfile(folder, [strrep(topic, "/", "_") ".csv"]);
  names = column_names(path);
  cells = read_cells(path, numel(names));
  values = 0;
  for i = 1:numel(names)
    field = regexprep(names{i}, "[^A-Za-z0-9_]", "_");
    texts = cells{i};
    numeric = ! any(isletter([texts{:}])) || isa(group.(field), "double");
    % Enums are names in CSV and numbers in HDF5, which the Python reader compares.
    if ischar(group.(field)) || numeric
      same = agrees(group.(field), texts);
      if numel(same) != numel(texts) || ! all(same)
        k = find(! same, 1);
        error("%s %s row %d: %s in CSV", topic, names{i}, k, texts{k});
      end
      values += numel(texts);
    end
  end
  printf("%s: %d values agree\n", topic, values);
end

arguments = argv();
log = load("-hdf5", arguments{1});
topics = {"inslab/truth", log.inslab.truth
          "inslab/imu/0", log.inslab.imu._0
          "inslab/imu_truth/0", log.inslab.imu_truth._0
          "inslab/gnss/0", log.inslab.gnss._0
          "inslab/nav", log.inslab.nav
          "inslab/time_mark", log.inslab.time_mark};
for i = 1:rows(topics)
  assert(check_topic(topics{i, 2}, arguments{2}, topics{i, 1}) > 0);
end
