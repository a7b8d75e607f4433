// Made by `make reference`: do not edit.
Declared {
    options: &[],
    others: &[],
    names: &[("json", "One document with all results"), ("csv", "The samples"), ("npz", "Samples and history as NumPy arrays"), ("jsonl", "JSON Lines: the definition of the run, a line for each sample during the run, and the result"), ("text", "A short summary as text")],
}
