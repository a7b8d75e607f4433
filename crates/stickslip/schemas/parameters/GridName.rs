// Made by `make reference`: do not edit.
Declared {
    options: &[],
    others: &[],
    names: &[("uniform", "The paper's method: heights on a uniform grid, all of them advanced at every stage; order 2"), ("windowed", "The same grid, but only heights within reach of the tip are updated; order 2"), ("spectral", "A lattice with narrower Gaussians for writing and reading: exact to round-off in space"), ("sinc", "Samples interpolated by a regularised sinc: a second method that is exact to round-off in space")],
}
