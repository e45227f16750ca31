//! Optics on X, Z and C: the lens of paper 004 and everything else that is turned.

mod lens;
