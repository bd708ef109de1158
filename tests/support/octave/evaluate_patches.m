% Reads isogeometric files with octave-nurbs and prints points of their surfaces, for tests.
%
%   octave-cli --no-history --quiet evaluate_patches.m N FILE...
%
% FILE: GeoPDEs text (.txt), G+Smo XML (.xml) or MFEM NURBS mesh (.mesh). Per patch N x N points at even parameters, u fastest, one a line.
1;
function s = nurbs (points, U, V, nu, nv)  % points homogeneous, u fastest
  s = nrbmak (reshape (points, 4, nu, nv), {U, V});
end
function all = geopdes (file)
  L = strsplit (fileread (file), "\n"); L = L(! strncmp (L, "#", 1));
  head = sscanf (L{1}, "%d"); k = 2; all = {};
  for p = 1:head(3)
    n = sscanf (L{k+2}, "%d");
    rows = cellfun (@(l) sscanf (l, "%f")', L(k+5:k+8), "UniformOutput", false);
    all{end+1} = nurbs (vertcat (rows{:}), sscanf (L{k+3}, "%f")', sscanf (L{k+4}, "%f")', n(1), n(2)); k += 9;
  end
end
function all = gismo (file)
  text = fileread (file); all = {};
  for g = regexp (text, '<Geometry (.*?)</Geometry>', "tokens")
    b = g{1}{1}; knots = regexp (b, '<KnotVector degree="(\d+)">([^<]*)<', "tokens");
    U = sscanf (knots{1}{2}, "%f")'; V = sscanf (knots{2}{2}, "%f")';
    nu = numel (U) - str2double (knots{1}{1}) - 1; nv = numel (V) - str2double (knots{2}{1}) - 1;
    c = reshape (sscanf (regexp (b, '<coefs geoDim="3">([^<]*)<', "tokens"){1}{1}, "%f"), 3, []);
    w = regexp (b, '<weights>([^<]*)<', "tokens");
    if (isempty (w)) w = ones (1, nu * nv); else w = sscanf (w{1}{1}, "%f")'; end
    all{end+1} = nurbs ([c .* w; w], U, V, nu, nv);
  end
end
function all = mfem (file)
  text = regexprep (fileread (file), '#[^\n]*', ""); all = {};
  blocks = strsplit (text, "knotvectors");
  for b = blocks(2:end)
    parts = strsplit (b{1}, "controlpoints_cartesian"); v = sscanf (strsplit (parts{1}, "dimension"){1}, "%f")';
    p = v(2); nu = v(3); U = v(4:4+p+nu); v = v(5+p+nu:end); q = v(1); nv = v(2); V = v(3:3+q+nv);
    c = reshape (sscanf (parts{2}, "%f"), 4, []);
    all{end+1} = nurbs ([c(1:3,:) .* c(4,:); c(4,:)], U, V, nu, nv);
  end
end
pkg load nurbs
a = argv (); t = linspace (0, 1, str2double (a{1}));
for f = 2:numel (a)
  [~, ~, ending] = fileparts (a{f});
  switch (ending) case ".xml", all = gismo (a{f}); case ".mesh", all = mfem (a{f}); otherwise, all = geopdes (a{f}); end
  for p = 1:numel (all)
    printf ("%.17g %.17g %.17g\n", reshape (nrbeval (all{p}, {t, t}), 3, []));
  end
end
