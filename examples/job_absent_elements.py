"""Job k: what is said of a machine element, a quantity or a key that does not exist."""

import rotorfilm as rf
from rotorfilm.scenes import parse_scene

text = 'schema = 1\n[journal]\ndiameter = "0.1 m"\nlength = "50 mm"\nclearence = "0.1 mm"\nviscosity = 0.1\n'
asked = (
    lambda: rf.FoilBearing,
    lambda: rf.JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity="0.1 mm"),
    lambda: rf.Trajectory(time=[0.0], signals={}, work={}).plot("bode"),
    lambda: parse_scene(text, "bearing.toml"),
)
said = []
for one in asked:
    try:
        one()
    except (AttributeError, rf.InputError, rf.core.SceneError) as error:
        said.append(f"{type(error).__name__}: {error}")
        print(said[-1])
print("wrong inputs that were named:", len(said))
