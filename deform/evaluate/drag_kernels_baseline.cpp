// The kernels of a drag for the instruction set that this source is compiled for.

#include "deform/evaluate/drag_kernels_body.inc"
