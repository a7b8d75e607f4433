//! How the program is linked.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let of_target = |name| std::env::var(format!("CARGO_CFG_TARGET_{name}")).unwrap_or_default();
    if of_target("OS") == "linux" && of_target("ENV") == "gnu" {
        // At a fixed address: a fifth of the time to start went to 23,000 addresses that a movable program fills in.
        println!("cargo:rustc-link-arg-bins=-no-pie");
    }
}
