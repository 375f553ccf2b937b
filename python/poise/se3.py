# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""SE(3), the group of poses X_AB as matrices [R p; 0 0 0 1].

A tangent vector is x = [w; v], angular part first, in rad and m.
"""

from poise import _poise

adjoint = _poise.se3.adjoint
dual_adjoint = _poise.se3.dual_adjoint
exp = _poise.se3.exp
hat = _poise.se3.hat
interpolate = _poise.se3.interpolate
inverse = _poise.se3.inverse
inverse_left_jacobian = _poise.se3.inverse_left_jacobian
inverse_right_jacobian = _poise.se3.inverse_right_jacobian
left_jacobian = _poise.se3.left_jacobian
log = _poise.se3.log
right_jacobian = _poise.se3.right_jacobian
vee = _poise.se3.vee
