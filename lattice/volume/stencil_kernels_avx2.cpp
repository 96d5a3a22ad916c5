// The kernel of re-posing for the instruction set that this source is compiled for.

#include "lattice/volume/stencil_kernels_body.inc"
