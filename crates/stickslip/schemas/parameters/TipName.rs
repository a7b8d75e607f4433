// Made by `make reference`: do not edit.
Declared {
    options: &[],
    others: &[],
    names: &[("triple-gaussian", "(48): a Gaussian with side lobes of weight -beta/2 at ±2 widths"), ("gaussian", "exp(-x²/(2 W²))"), ("bessel", "The Bessel function J0(x)"), ("cosine", "cos x, for tips without a spring or on a surface that heals")],
}
