"""What stands in for the world: robot and scene in MuJoCo, cameras, haptic stylus, the operator's hand."""

import os

# MuJoCo loads the drawing library that this variable names when it is first imported, and fails where another project's
# choice is not installed; `sim.world.drawing` looks for one when something is to be drawn.
os.environ["MUJOCO_GL"] = "disable"
