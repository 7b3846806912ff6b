"""H.-J. Butenschoen (1976), as tabulated in mbdyn_post_ehd_load_output_01.tst of mboct-mbdyn-pkg.

L/D, eccentricity ratio, Sommerfeld number, attitude angle [deg], side flow/(R^3 psi omega); the film starts
at the widest gap.
"""

BUTENSCHOEN = [
    (1.0, 0.1, 0.1196, 79.410, 0.1603),
    (1.0, 0.3, 0.4091, 68.264, 0.4765),
    (1.0, 0.5, 0.8903, 56.705, 0.7852),
    (1.0, 0.7, 2.0432, 43.859, 1.0888),
    (1.0, 0.9, 8.4352, 26.482, 1.3898),
    (0.25, 0.1, 0.0098, 82.481, 0.0492),
    (0.25, 0.5, 0.0888, 54.069, 0.2460),
    (0.25, 0.9, 2.1595, 21.790, 0.4436),
]
