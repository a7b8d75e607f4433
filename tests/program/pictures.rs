//! Is every saved document drawn, and as `--plot` draws it? As large, and as far, as asked for?

use crate::folder::Folder;

/// Of each kind of document a command that writes and draws one.
const COMMANDS: [(&str, &str); 10] = [
    ("run", "run --alpha 1.2 --r 1 --kick 0.05 --until 60 --pulse 0.1,40,1"),
    ("long", "run --alpha 1.2 --r 1 --kick 0.05 --until 600"),
    ("stability", "stability --alpha 1.2 --r 1"),
    ("boundary", "boundary --r-range 0.1,2 --points 40"),
    ("cycle", "cycle --alpha 1.2 --r 1"),
    ("continue", "continue --r 1 --over alpha --to 1.2"),
    ("map", "sweep --r 0.5:1.5:4 --alpha 0.5:2.5:4"),
    ("row", "sweep --r 1 --alpha 0.9:2.4:6"),
    ("response", "response --alpha 0.9 --r 1 --pulse 1e-4,30,0.5 --until 60"),
    ("compare", "compare --alpha 1.2 --r 1 --kick 0.05 --until 40"),
];

#[test]
fn a_saved_document_is_drawn_as_its_command_drew_it() {
    let folder = Folder::new("plot-saved");
    let mut made: Vec<(String, String)> =
        COMMANDS.iter().map(|(name, line)| ((*name).to_owned(), (*line).to_owned())).collect();
    made.push(("surface".into(), "surface run.json --at 30,60 --spacing 0.2".into()));
    let image = "surface run.json --at 60 --range 40,60 --y-range -2,2 --spacing 0.5";
    made.push(("image".into(), image.into()));
    for (name, line) in made {
        folder.prints(&format!("{line} -o {name}.json --plot {name}.svg"));
        folder.prints(&format!("plot {name}.json -o again.svg"));
        let [first, again] = [format!("{name}.svg"), "again.svg".into()].map(|f| folder.read(&f));
        assert!(first == again, "{name}: {} and {} bytes", first.len(), again.len());
        let picture = String::from_utf8(first).unwrap();
        assert!(picture.starts_with("<svg") && picture.len() > 3000, "{name}");
        assert!(!picture.contains("NaN") && !picture.contains("inf"), "{name}");
        assert!(picture.contains("β = 1"), "{name}: which tip?");
    }
    folder.prints("boundary --r-range 0.1,2 --points 40 -o b.json --plot-onset onset.svg");
    folder.prints("plot b.json --onset -o again.svg");
    assert!(folder.read("onset.svg") == folder.read("again.svg"));
    folder.prints("figures --out-dir . --only fig6");
    folder.prints("plot fig6.json -o again.svg");
    assert!(folder.read("fig6.svg") == folder.read("again.svg"));
}

#[test]
fn the_title_of_a_branch_names_the_terms_of_its_model() {
    let folder = Folder::new("plot-branch");
    let law = "--depth-limit 30 --healing-time 15 --inertia 0.3";
    folder.prints(&format!("continue --r 1 --over alpha --to 1.5 {law} -o c.json --plot c.svg"));
    let picture = String::from_utf8(folder.read("c.svg")).unwrap();
    for term in ["b = 30", ">h</tspan>", "= 15", "M = 0.3"] {
        assert!(picture.contains(term), "{term} in the title");
    }
}

#[test]
fn a_run_without_its_history_is_drawn_from_its_samples() {
    let folder = Folder::new("plot-samples");
    let run =
        "run --alpha 1.2 --r 1 --kick 0.05 --until 60 --history none -o run.json --plot a.svg";
    folder.prints(run);
    folder.prints("plot run.json -o b.svg");
    let [whole, less] = ["a.svg", "b.svg"].map(|f| String::from_utf8(folder.read(f)).unwrap());
    assert!(whole.contains("u(x, t = 60)") && !less.contains("u(x, t = 60)"));
    assert!(less.contains("samples"));
}

#[test]
fn width_and_range_are_as_asked() {
    let folder = Folder::new("plot-size");
    folder.prints("run --alpha 1.2 --r 1 --kick 0.05 --until 200 -o run.json");
    folder.prints("plot run.json -o a.svg --width 85mm --x-range 150:160 --y-range -1:3");
    let picture = String::from_utf8(folder.read("a.svg")).unwrap();
    assert!(picture.contains("width=\"85mm\"") && picture.contains(">152</text>"));
    assert!(!picture.contains(">100</text>"), "the rest is not shown");
    folder.prints("plot run.json -o b.svg --width 600px");
    let picture = String::from_utf8(folder.read("b.svg")).unwrap();
    assert!(picture.contains("viewBox=\"0 0 600 ") && picture.contains("width=\"600\""));
    if cfg!(feature = "png") {
        folder.prints("plot run.json -o a.png --width 127mm --dpi 300");
        let png = folder.read("a.png");
        assert_eq!(png[16..20], 1500_u32.to_be_bytes());
        let at =
            png.windows(4).position(|w| w == b"pHYs").expect("it says how large its pixels are");
        // 300 to an inch are 11,811 to a metre.
        assert_eq!(png[at + 4..at + 8], 11_811_u32.to_be_bytes());
    }
    if cfg!(feature = "pdf") {
        folder.prints("plot run.json -o a.pdf --width 127mm");
        let pdf = folder.read("a.pdf");
        assert!(pdf.starts_with(b"%PDF-"));
        let text = String::from_utf8_lossy(&pdf);
        assert!(text.contains("/MediaBox [0 0 360 "), "127 mm are 360 points");
    }
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let folder = Folder::new("plot-refused");
    folder.write("units.json", "{\"format\":\"stickslip/units\",\"format_version\":1}");
    folder.prints("run --alpha 1.2 --r 1 --until 30 -o run.json");
    folder.prints("sweep --r 1 --alpha 1.2 -o point.json");
    folder.write("broken.json", "{\"format\":\"stickslip/run\"");
    let damaged = "{\"format\":\"stickslip/figure\",\"format_version\":1}";
    folder.write("damaged.json", damaged);
    for (line, said) in [
        ("plot units.json -o a.svg", ["DOCUMENT.json units.json", "stickslip/run"]),
        ("plot none.json -o a.svg", ["DOCUMENT.json none.json", "cannot be read"]),
        ("plot broken.json -o a.svg", ["broken.json", "not a complete JSON document"]),
        ("plot damaged.json -o a.svg", ["damaged.json", "damaged"]),
        ("plot point.json -o a.svg", ["point.json", "LO:HI:N"]),
        ("plot run.json -o a.jpg", ["--output a.jpg", ".svg, .png or .pdf"]),
        ("plot run.json -o a.svg --width 85", ["--width 85", "85mm"]),
        ("plot run.json -o a.svg --width 1mm", ["--width 1mm", "49mm"]),
        ("plot run.json -o a.svg --dpi 0", ["--dpi 0", "10 to 10000"]),
        ("plot run.json -o a.svg --x-range 5", ["--x-range 5", "LO:HI"]),
        ("plot run.json -o a.svg --y-range 3:1", ["--y-range 3:1", "LO below HI"]),
        ("plot run.json -o a.svg --onset", ["--onset", "stickslip/boundary"]),
        ("plot run.json -o run.json", ["run.json", "run.json"]),
    ] {
        folder.refuses(line, &said);
    }
}
