// Made by `make reference`: do not edit.
Declared {
    options: &[],
    others: &[],
    names: &[],
}
