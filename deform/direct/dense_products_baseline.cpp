// Dense products for the instruction set that this source is compiled for.

#include "deform/direct/dense_products_body.inc"
