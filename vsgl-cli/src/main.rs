//! The program `vsgl`.

fn main() -> std::process::ExitCode {
    vsgl_cli::main()
}
