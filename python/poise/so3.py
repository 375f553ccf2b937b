# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""SO(3), the group of rotations R_AB with v_A = R_AB v_B. Angles are in rad."""

from poise import _poise

exp = _poise.so3.exp
from_rpy = _poise.so3.from_rpy
hat = _poise.so3.hat
interpolate = _poise.so3.interpolate
inverse_left_jacobian = _poise.so3.inverse_left_jacobian
inverse_right_jacobian = _poise.so3.inverse_right_jacobian
left_jacobian = _poise.so3.left_jacobian
log = _poise.so3.log
matrix = _poise.so3.matrix
project = _poise.so3.project
quaternion = _poise.so3.quaternion
right_jacobian = _poise.so3.right_jacobian
rpy = _poise.so3.rpy
vee = _poise.so3.vee
