# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# What vivado.tcl and quartus.tcl know of a release archive.

namespace eval openmb4 {
  variable tops {mb4_core mb4_axil mb4_wb}
  variable presets {full drive single reader}

  # Unpacks openmb4-VERSION.tar.gz into a folder; returns the release's own folder there.
  proc unpack {archive folder} {
    file mkdir $folder
    exec tar -xzf $archive -C $folder
    set name [file rootname [file rootname [file tail $archive]]]
    set release [file normalize [file join $folder $name]]
    if {![file isdirectory [file join $release rtl]]} {
      error "$archive holds no $name/rtl: is it a release of openmb4?"
    }
    return $release
  }

  # The files that a list names, those of the lists it names included, in their order.
  proc listed {list} {
    set files {}
    set input [open $list]
    foreach line [split [read $input] "\n"] {
      set line [string trim $line]
      if {[string match "-F *" $line]} {
        lappend files {*}[listed [file join [file dirname $list] [string range $line 3 end]]]
      } elseif {$line ne "" && ![string match "//*" $line]} {
        lappend files [file normalize [file join [file dirname $list] $line]]
      }
    }
    close $input
    return $files
  }

  proc rtl {release} {
    return [listed [file join $release rtl mb4 mb4.f]]
  }

  # The word FEATURES of a preset, as a number.
  proc features {release preset} {
    set input [open [file join $release regmap mb4_page.rdl]]
    set text [read $input]
    close $input
    set name FEATURES_[string toupper $preset]
    if {![regexp "\"$name\", value: (0x\[0-9A-F\]+)" $text - value]} {
      error "$preset is no preset of this release"
    }
    return [expr {$value}]
  }

  # The constraints of a top with a preset; the file's name is TOP and this ending.
  proc constraints {release top preset ending} {
    set folder [file join $release rtl mb4 constraints]
    if {$preset ne "full"} {
      set folder [file join $folder $preset]
    }
    return [file join $folder $top$ending]
  }

  # Stops at words that are no top and no preset.
  proc check {top preset} {
    variable tops
    variable presets
    if {$top ni $tops || $preset ni $presets} {
      error "TOP is one of $tops, PRESET one of $presets"
    }
  }
}
