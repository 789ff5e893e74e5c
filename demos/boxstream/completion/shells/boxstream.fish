# SPDX-License-Identifier: MIT
# Completion of boxstream in fish: the program that is typed says itself what fits.
function __boxstream_complete
    set -l typed (commandline -opc)
    set -l begun "$(commandline -ct)"
    set -l lines ($typed[1] complete -- $typed[2..] $begun 2>/dev/null)
    printf '%s\n' $lines[2..]
    set -l path (string replace -r '^--[^=]*=' '' -- $begun)
    set -l before (string match -r '^--[^=]*=' -- $begun)
    switch "$lines[1]"
        case files
            printf "$before%s\n" (__fish_complete_path $path)
        case directories
            printf "$before%s\n" (__fish_complete_directories $path '')
    end
end
complete -c boxstream -f -a '(__boxstream_complete)'
