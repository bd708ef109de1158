"""usage: on_terminal.py TEXT SIGNAL COMMAND... - runs a command on a terminal of its own and sends it a signal as soon as it shows a
text; prints what it wrote, exits as it does."""
import os, pty, signal, sys

text, number = sys.argv[1].encode(), getattr(signal, sys.argv[2])
child, terminal = pty.fork()
if child == 0:
    os.execvp(sys.argv[3], sys.argv[3:])
shown, sent = b"", False
while True:
    try:
        piece = os.read(terminal, 4096)
    except OSError:  # its end, on Linux
        break
    if not piece:
        break
    shown += piece
    if not sent and text in shown:
        os.kill(child, number)
        sent = True
sys.stdout.buffer.write(shown)
sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
