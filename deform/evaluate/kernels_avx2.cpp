// The evaluation kernels for the instruction set that this source is compiled for.

#include "deform/evaluate/kernels_body.inc"
